# SPDX-License-Identifier: MIT
"""Libraries that decide the bits of a picture call no transcendental function for floats of the C library.

C libraries round these differently: acosf of glibc 2.36 and 2.41 gave tangents, and so pictures, with other bits. Those
for doubles are within 1 ulp of a double, and code rounds their results to float, so that they differ about once in 2^28.

    libm_test.py ARCHIVE...
"""

import re
import subprocess
import sys

FUNCTION = re.compile(r"(.*):\s+U (a?(?:cos|sin|tan)h?|atan2|sincos|exp(?:2|10|m1)?|log(?:2|10|1p)?|pow|cbrt|hypot)f$")


def main(archives):
    faults = 0
    symbols = 0
    for archive in archives:
        text = subprocess.run(["nm", "-uA", archive], check=True, capture_output=True, text=True).stdout
        for line in text.splitlines():
            symbols += 1
            if found := FUNCTION.match(line):
                print(f"{found[1]} calls {found[2]}f; compute in double and round the result")
                faults += 1
    if symbols == 0:
        sys.exit("nm lists no symbol")
    sys.exit(1 if faults else 0)


main(sys.argv[1:])
