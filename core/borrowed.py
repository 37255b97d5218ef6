"""Arrays whose references are not counted."""

from typing import Any

from numba import extending, types
from numba.core import cgutils


@extending.intrinsic
def borrowed(_typing: Any, values: Any) -> Any:
    """Return the same values, the references to their arrays uncounted: kernels that Python calls begin with it.

    To count them takes up to half of the time of a scene, and lets threads wait for each other. Python holds the arrays
    for as long as its call lasts.
    """

    def without_owner(context: Any, builder: Any, kind: Any, value: Any) -> Any:
        """Write the code for a value: an array without its owner, a tuple of such items."""
        if isinstance(kind, types.Array):
            owner = context.data_model_manager.lookup(kind).get_field_position("meminfo")
            return builder.insert_value(value, cgutils.get_null_value(value.type.elements[owner]), owner)
        for i, item in enumerate(kind if isinstance(kind, types.BaseTuple) else ()):
            own = without_owner(context, builder, item, builder.extract_value(value, i))
            value = builder.insert_value(value, own, i)
        return value

    def write(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        """Write the code of a call."""
        return without_owner(context, builder, signature.return_type, arguments[0])

    return values(values), write
