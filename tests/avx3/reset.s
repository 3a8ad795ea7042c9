# The guest's whole firmware: from the CPU's reset into a Linux kernel that lies in memory already.
# The kernel is entered as PVH guests are (xen/include/public/arch-x86/hvm/start_info.h): 32-bit protected mode without
# paging, ebx = start_info. A ROM of 4 KB that ends at 4 GB, seen at 0xff000 too. guest.py defines the symbols KERNEL,
# KERNEL_ENTRY, INITRAMFS, INITRAMFS_SIZE and MEMORY.
        .set    rom, 0xff000

        .code16
start:  cli
        lgdtl   %cs:0xf000 + gdt_register - start
        mov     %cr0, %eax
        or      $1, %al
        mov     %eax, %cr0
        ljmpl   $8, $rom + protected - start

        .code32
protected:
        mov     $16, %eax
        mov     %eax, %ds
        mov     %eax, %es
        mov     %eax, %ss
        # Bochs gives memory out by blocks of 128 KB in the order in which they are first touched, but reads an image
        # into it in one piece. Touching the blocks in order brings each to the piece of the image that it should hold.
        mov     $KERNEL, %esi
1:      mov     (%esi), %al
        add     $0x20000, %esi
        cmp     $INITRAMFS + INITRAMFS_SIZE, %esi
        jb      1b
        mov     $rom + start_info - start, %ebx
        mov     $KERNEL_ENTRY, %eax
        jmp     *%eax

        .balign 8
gdt:    .quad   0, 0x00cf9b000000ffff, 0x00cf93000000ffff # code and data: flat, 4 GB
gdt_register:
        .word   . - gdt - 1
        .long   rom + gdt - start

        .balign 8
start_info:
        .long   0x336ec578, 1, 0, 1 # magic, version, flags, modules
        .quad   rom + module - start, rom + command_line - start, 0, rom + memory_map - start
        .long   2, 0
module: .quad   INITRAMFS, INITRAMFS_SIZE, 0, 0
memory_map: # address, size, type (1: RAM), reserved
        .quad   0, 0xa0000, 1
        .quad   0x100000, MEMORY - 0x100000, 1
command_line:
        .asciz  "console=ttyS0 loglevel=0 panic=-1 nokaslr nosmp noapic nolapic mitigations=off clearcpuid=xsavec,xsaves"

        .code16
        .org    0xff0 # where the CPU begins, with cs based at 0xffff0000
        jmp     start
        .org    0x1000
