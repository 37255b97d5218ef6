"""How kernels are compiled, linked and kept; nothing here depends on a particular kernel.

jit         the one decorator of every kernel, and what is heard of compilations
pipeline    the steps in which a kernel becomes code
borrowed    kernels that own no array count no references
linking     each entry is optimised once, with all that it calls
resolving   what numba's own functions give is found once
collecting  garbage is looked for seldom meanwhile
keeping     where an entry is looked for before it is compiled
ahead       code that came with the program
cache       the folder of compiled code, and what has been compiled there
owners      who can change what is kept there
sources     digests of the sources
"""
