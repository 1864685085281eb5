"""The inch and the pound in the package's units; the only place where they are converted.

>>> print(f"{392.6 * N_PER_LBF / MM_PER_INCH:.2f} N/mm are 392.6 lb/in")
68.75 N/mm are 392.6 lb/in
"""

from cammotion.machine.kinematics import STANDARD_GRAVITY

MM_PER_INCH = 25.4
KG_PER_LB = 0.45359237
N_PER_LBF = KG_PER_LB * STANDARD_GRAVITY
