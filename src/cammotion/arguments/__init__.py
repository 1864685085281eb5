"""What is given to a public name: a call that fits, arguments of the kind that it says."""

from cammotion.arguments.calls import called, warn
from cammotion.arguments.kinds import checked

__all__ = ["called", "checked", "warn"]
