"""The processors whose instructions are counted."""

from functools import partial

from unicorn.arm_const import UC_CPU_ARM_CORTEX_M0, UC_CPU_ARM_CORTEX_M4

from cortex_m import CortexM
from x86 import X86

# By the name that stands in the names of images. A Cortex-M0+ executes what a Cortex-M0 does.
PROCESSORS = {
    "m0plus": partial(CortexM, model=UC_CPU_ARM_CORTEX_M0),
    "m4": partial(CortexM, model=UC_CPU_ARM_CORTEX_M4),
    "x86": X86,
}
