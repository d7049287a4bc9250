# SPDX-License-Identifier: MIT
"""Turns keyword arguments into the settings of `metamarch render`. The program declares the settings; nothing here
names one."""
import difflib
import numbers
import os

import numpy as np

from . import _native

LOAD, RENDER, SAVE = ({option["name"].replace("-", "_"): option for option in options} for options in _native.options())


def words_of(call, options, given):
    """Returns the settings that `given` names, as pairs of a name and a text. None stands for the default.

    Raises TypeError for a name that `options` lacks, and InvalidArgument for a value that no text stands for.
    """
    words = []
    for name, value in given.items():
        if name not in options:
            near = difflib.get_close_matches(name, options, 1)
            hint = f"; did you mean {near[0]!r}?" if near else f"; see help(metamarch.{call})"
            raise TypeError(f"{call}() has no option {name!r}{hint}")
        if value is not None:
            text = _text_of(name, options[name], value)
            if text is not None:
                words.append((options[name]["name"], text))
    return words


def _text_of(name, option, value):
    if option["kind"] == "flag":
        if not isinstance(value, (bool, np.bool_, numbers.Integral)) or value not in (0, 1):
            raise _native.InvalidArgument(f"{name}={value!r}: give True or False")
        return "on" if value else None
    if isinstance(value, (bool, np.bool_)):
        raise _native.InvalidArgument(f"{name}={value!r}: give a value")
    if isinstance(value, os.PathLike):
        return os.fsencode(value)
    if isinstance(value, str):
        return value
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    try:
        parts = [_text_of(name, option, part) for part in value]
    except TypeError:
        raise _native.InvalidArgument(f"{name}={value!r}: give text, a number or several") from None
    return ("x" if option["value_name"] == "WxH" else ",").join(parts)


def help_text(options):
    """Returns a line for each option, for a docstring."""
    lines = []
    for name, option in options.items():
        default = f" (default {option['default']})" if option["default"] and option["kind"] != "flag" else ""
        lines.append(f"    {name}: {option['help']}{default}")
    return "\n".join(lines)
