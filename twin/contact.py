"""What a solver of one scene asks of its equilibrium curve, whatever the profile and the control are."""

from typing import Any, Protocol

from flint import arb


class Contact(Protocol):
    """An equilibrium curve by the phase z; Y is what is prescribed, the tilt has the sign of its slope."""

    rim: arb | None
    wavelength: arb
    fold: Any
    """The control whose tilt vanishes at the extrema of Y."""
    trough: Any
    """The control whose tilt vanishes at the extrema of P."""
    starts_rising: bool
    """Whether Y rises from a = 0 on."""
    work: arb
    """The work of adhesion over dgamma."""
    shortest: int
    """Waves of the shortest kind in a wavelength."""
    innermost: float
    """Phase up to which an integrand has a branch point at a = 0 and is smooth besides."""

    def radius(self, z: arb) -> arb:
        """Return the radius a at the phase z."""
        ...

    def coordinate(self, z: arb) -> arb:
        """Y in equilibrium."""
        ...

    def slope(self, z: arb) -> arb:
        """Return the derivative of Y in z."""
        ...

    def tilt(self, z: arb, control: Any) -> tuple[arb, arb]:
        """Return the tilt and its derivative in z (enclosures when z is a ball)."""
        ...

    def grid(self, control: Any, end: arb | None) -> list[arb]:
        """Return phases, up to `end`, that cut the window of all zeros of a tilt into pieces for it."""
        ...

    def delta(self, z: arb) -> arb:
        """Indentation in equilibrium."""
        ...

    def force(self, z: arb) -> arb:
        """Load P in equilibrium."""
        ...

    def ratio(self, z: arb, level: arb) -> arb:
        """Rho = x/Delta at a coordinate that is held, Delta that of dgamma: the drop of energy is `release` - rho^2."""
        ...

    def release(self, z: arb) -> arb:
        """Return the work of adhesion at a radius, over dgamma."""
        ...

    def pinned(self, z: arb) -> arb:
        """Return what is prescribed, a depth under a load, between the curve of dgamma and that of the work."""
        ...

    def force_at_zero(self, z: arb) -> arb:
        """Load of a contact of this radius at the coordinate 0, in equilibrium or not."""
        ...

    def depth_at_full_contact(self, level: arb) -> arb:
        """Depth of the contact pinned at the rim where the coordinate has reached `level`."""
        ...

    def work_at_rim(self, level: arb) -> arb:
        """Return the integral of P dY over the pinned contact, from the coordinate of the rim to `level`."""
        ...

    def force_size(self, z: arb) -> arb:
        """Return the sum of the sizes of the terms of P."""
        ...

    def coordinate_size(self, z: arb) -> float:
        """Return the size of the terms of Y that do not cancel."""
        ...

    def depth_size(self, z: arb) -> float:
        """Return the size of the terms of delta, and of its change with the phase, where a path ends."""
        ...

    def full_depth_size(self, z: arb) -> float:
        """Return the same of the depth at full contact, whose coordinate is that of the phase z."""
        ...

    def tilt_size(self, z: arb, control: Any) -> arb:
        """Return the size of the terms of the tilt but the waves."""
        ...
