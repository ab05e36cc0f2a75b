/* A bare Cortex-M in qemu: where it starts, and texts to the machine that runs it. */
#ifndef BOARD_H
#define BOARD_H

#include <stddef.h>
#include <stdint.h>

int main(void);

static void service(int what, const void *with)
{
    register int r0 __asm__("r0") = what;
    register const void *r1 __asm__("r1") = with;

    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

static void start(void)
{
    *(volatile uint32_t *)0xE000ED88u |= 0xFu << 20; /* floating point on */
    __asm__ volatile("dsb\n\tisb");
    main();
    service(0x18, (const void *)0x20026);
}

static const uintptr_t vectors[2] __attribute__((section(".vectors"), used)) = {
    0x20400000u, (uintptr_t)start
};

/* The bytes of numbers as a line of hexadecimal digits. */
static void say_bytes(const void *numbers, size_t length)
{
    static const char digits[] = "0123456789abcdef";
    const unsigned char *const bytes = numbers;
    char text[3] = {0};

    for (size_t i = 0; i < length; i++) {
        text[0] = digits[bytes[i] >> 4];
        text[1] = digits[bytes[i] & 15];
        service(4, text);
    }
    service(4, "\n");
}

#endif
