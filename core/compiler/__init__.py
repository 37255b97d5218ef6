"""How kernels are compiled, linked and kept; nothing here depends on a particular kernel.

jit         the one decorator of every kernel, and notices of compilations
pipeline    the steps in which a kernel becomes code
borrowed    kernels that own no array count no references
linking     each entry is optimised once, with all that it calls
resolving   the types of numba's own functions are found once
collecting  garbage is collected less often meanwhile
keeping     where an entry is searched before it is compiled
ahead       code that came with the program
cache       the folder of compiled code, and what has been compiled there
owners      who can change what is kept there
sources     digests of the sources
"""
