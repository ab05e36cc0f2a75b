"""C99 that needs no allocation and no library but <math.h>."""
