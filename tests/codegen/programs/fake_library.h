/* What the C library declares, as far as a parser has to know it: types. */
#ifndef FAKE
#define FAKE
typedef unsigned long size_t; typedef long ptrdiff_t; typedef unsigned long uintptr_t;
typedef unsigned char uint8_t; typedef unsigned int uint32_t; typedef unsigned long uint64_t;
typedef signed char int8_t; typedef short int16_t; typedef unsigned short uint16_t;
typedef int int32_t; typedef long int64_t; typedef struct FILE FILE; typedef _Bool bool;
typedef int va_list;
#define NULL ((void *)0)
#define INFINITY 1e999
#define NAN 0e0
#define HUGE_VAL 1e999
#define true 1
#define false 0
#endif
