"""What the codes in arrays stand for."""

from enum import IntEnum


class ContactKind(IntEnum):
    """Whether the two sides pass through each other at the first contact.

    With a radius: whether they do so within the step. After a graze they may cross later in the
    step, so respond to both."""

    CROSSING = 1
    """They swap sides."""
    GRAZE = 2
    """They touch without swapping sides."""


class Blocked(IntEnum):
    """Why a step is not a whole one."""

    NOT = 0
    """It is."""
    AHEAD = 1
    """A larger step would bring the two sides nearer than is kept, or a rounding error of that."""
    ROUNDING = 2
    """The two sides come nearer, and start so near to what is kept that rounding has no room. A few
    steps were tried; the largest of them that is proved is made, or none."""
    TOUCHING = 3
    """The two sides touch at the start, radius or not: no motion from there is apart."""


class Feature(IntEnum):
    """A part of a mesh."""

    VERTEX = 1
    """A vertex."""
    EDGE = 2
    """An edge."""
    FACE = 3
    """A face."""
