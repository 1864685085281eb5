"""What installers and operating systems say when they fail, put into words of what to do."""

import re

from starter.paths import PYTHON_VERSION, START

DISK_FULL = "The disk is full. Make room and start again."
FORBIDDEN = (
    "A rule of this computer (a group policy, or application control) forbids programs in this "
    "folder. Ask whoever looks after the computer to allow those in .venv, or to set the "
    "workbook up where programs may run: you can start it there with --work and the path of a "
    "folder of your own."
)
TOO_LONG = (
    "A path is too long for this system. Move the workbook into a folder with a short path, "
    "such as C:\\cam, and start again."
)
OF_A_START = (DISK_FULL, FORBIDDEN, TOO_LONG)  # the others are of an installation
ELSEWHERE = "or start in another network, such as at home: later starts need none."

# The first pattern that is found explains a failure; Windows is known by its numbers, since its
# words are in any language. What explains more comes before what explains less.
REASONS = {
    r"no space left on device|e(rrno|rror) 28\b|not enough space on|quota exceeded": DISK_FULL,
    r"certificate (has |is )?(expired|not yet valid)|peer certificate: (expired|notvalidyet)": (
        "The certificate of the package index counts as expired, or as not yet valid. Is the date "
        "of this computer right? Set it and start again."
    ),
    r"certificate.verify.failed|SSLCertVerificationError|invalid peer certificate"
    r"|confirming the ssl certificate": (
        "Something between this computer and the package index, an inspecting proxy or a virus "
        "scanner, shows a certificate of its own, which the installer does not know. Ask whoever "
        "runs the network for it as a .pem file, set the variable PIP_CERT (with uv: "
        f"SSL_CERT_FILE) to the path of that file, and start again; {ELSEWHERE}"
    ),
    r"\b407 proxy|proxy authori[sz]ation required": (
        "The proxy of this network asks for a name and a password. Set the variable HTTPS_PROXY to "
        "http://NAME:PASSWORD@HOST:PORT, as whoever runs the network tells you, and start again."
    ),
    r"\b403 (client error|forbidden)|http error 403|\(403 forbidden\)|tunnel error: unsuccessful": (
        "The download is forbidden: a filter or a proxy of this network, or the package index "
        "itself, refuses it. Ask whoever runs the network to let the addresses in the lines above "
        f"through, and start again; {ELSEWHERE}"
    ),
    r"(winerror|os error) (1260|4551)\b|group policy|application control policy"
    r"|disallowed by system policy": FORBIDDEN,
    r"(winerror|os error) (362|396)\b|incompatible hardlinks": (
        "The folder is kept in step with a cloud, as by OneDrive, which refuses the links that uv "
        "makes. Move the workbook out of it, into a folder such as C:\\cam, and start again; or "
        "set the variable UV_LINK_MODE to copy."
    ),
    r"long path support|(winerror|os error) 206\b|file name too long|e(rrno|rror) (36|63)\b"
    r"|[a-z]:\\[^'\"`:\n]{250}": TOO_LONG,
    # 5 and 32 are other errors where it is not Windows that says so.
    r"winerror (5|32)\b|errno 13\b|permission denied|access is denied"
    r"|(?<!output error )\(os error 5\)|(?<!pipe )\(os error 32\)": (
        "A file is in use, or closed to you. Close JupyterLab and whatever else uses the workbook, "
        "wait until a virus scanner or OneDrive has done with the folder, and start again; where "
        f"the folder is not yours, its owner has to run: {START} setup"
    ),
    r"NewConnectionError|NameResolutionError|ConnectTimeout|ReadTimeout|ProxyError|SSLError"
    r"|name or service not known|name resolution|getaddrinfo failed|nodename nor servname"
    r"|connection (refused|reset|aborted)|unreachable|no route to host|timed out|dns error"
    r"|error sending request|tcp connect error|to proxy|tunnel connection failed": (
        "There is no connection to the package index. Check the network (and the proxy, if there "
        "is one) and start again: a second start continues with what was downloaded."
    ),
    r"from versions: none|not found in the package registry": (
        "The package index answers, but has nothing of a package: a filter of this network may "
        "answer in its place, or the installer is set to an index of your own that lacks the "
        f"package. Ask whoever runs the network, {ELSEWHERE}"
    ),
    r"no matching distribution|could not find a version|no solution found|different python"
    r"|failed building wheel|failed to build|subprocess-exited-with-error": (
        "A package in environment.txt, in the version it asks for, is not to be had for Python "
        f"{PYTHON_VERSION} on this machine. The workbook is tested with Python 3.11 to 3.14."
    ),
    r"no module named '?pip\b": (
        "The environment in .venv has no pip that works. Delete the folder .venv and start again: "
        "it is made anew."
    ),
}


def find(said: str) -> str | None:
    """Return what explains a failure, and what to do; None if it is not known."""
    return next(
        (sentence for pattern, sentence in REASONS.items() if re.search(pattern, said, re.I)), None
    )
