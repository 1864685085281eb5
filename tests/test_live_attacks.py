"""A description may be a stranger's: nothing that is no formula is ever run by a page."""

import node

ATTACKS = """
constructor c0.constructor window fetch(1) `a` abs`1` ${1} `${c0}` c0[0] [] {} 1} 'a' "a" 1// /*1*/1
1/**/ <!--1 1--> (x)=>x ()=>1 x=>x z1=>z1 (z1)=>{1} (c0)=>1 x=1 E=1 c0=c1 c0++ --c0 c0+=1 c0**=2
c0||=1 c0&&=1 c0??=1 c0**2 NaN=1 (z1)=>z1=1 this import(1) eval(1) Function Math globalThis self top
location document 0x10 0b1 0o7 1n 1_0 1..constructor 1.constructor c0?.constructor c0?.[0] 1;
abs.constructor zsin c0abs absabs abs1 sin$ _ $ \\u0061lert(1) \u0430bs sin;cos c0,alert @ #a
x10 y0 z c f q isNaN undefined arguments yield let ...c0 c0<<2 c0>>2 ~c0 c0^1 c0&1 c0|1 toString
__proto__ hasOwnProperty
"""
SPACED = ["new abs", "async (z1)=>1", "void 0", "delete c0", "c0 in c1", "typeof c0", "c0 ++"]
SPACED += ["1 // 2", "1 .constructor", "1\n", "\n//", "1\u2028", "1\r", "a\u200bbs", "1\t"]
ENDLESS = ["1" * 10**5 + "#", "y" * 10**5 + "!", "1" * 10**5 + "x0", "(z1)=>" * 10**4 + "#"]


def test_what_is_no_formula_is_never_run() -> None:
    attacks = [*ATTACKS.split(), *SPACED, *ENDLESS]
    script = """
    let ran = 0;
    globalThis.Function = new Proxy(Function, { construct() { ran += 1; return () => () => []; } });
    return given.attacks.flatMap((formula) => ["formulas", "quantities"].map((place) => {
      const description = { formulas: ["1"], quantities: ["1"], controls: [{}, {}] };
      description[place] = ["c0", formula];
      try { compile(description); } catch (error) { return error.message; }
      return "taken";
    })).concat(ran);
    """
    *said, ran = node.run(script, {"attacks": attacks})
    taken = [attacks[at // 2] for at, words in enumerate(said) if "is no formula" not in words]
    assert taken == []
    assert ran == 0
    strange = [[1], [["1", "alert(1)"]], "alert", [{}], [None], {"0": "alert"}]
    script = """
    return given.map((formulas) => {
      try { compile({ formulas, quantities: [], controls: [] })([], []); }
      catch { return "refused"; }
      return "taken";
    })
    """
    assert node.run(script, strange) == ["taken", *["refused"] * 5]  # a number is a formula
