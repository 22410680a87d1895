/**
 * Where things are on an RP2040 (datasheet, section 2.2). All addresses in bytes.
 */

export const ROM_SIZE = 16 * 1024;
export const FLASH_BASE = 0x1000_0000;
/** First address after the four views of the flash (cached, not allocating, not cached, neither). */
export const FLASH_VIEWS_END = 0x1400_0000;
export const SRAM_BASE = 0x2000_0000;
export const SRAM_SIZE = 264 * 1024;
/** Where the boot ROM puts the second-stage bootloader: the last 256 bytes of SRAM5. */
export const BOOT2_RUN_ADDRESS = 0x2004_1f00;
export const USB_RAM_BASE = 0x5010_0000;
export const USB_RAM_SIZE = 4 * 1024;
export const SIO_BASE = 0xd000_0000;
export const PPB_PAGE = 0xe000_e000;

/** Keys of the peripheral table of `rp2040js`: the address without its last 14 bits, times four. */
export const PERIPHERAL = {
  xipCtrl: 0x14000,
  ssi: 0x18000,
  ioQspi: 0x40018,
  uart0: 0x40034,
  uart1: 0x40038,
  timer: 0x40054,
  watchdog: 0x40058,
  rosc: 0x40060,
  vregAndChipReset: 0x40064,
};

/** Interrupt numbers (datasheet, section 2.3.2). */
export const IRQ = { timer0: 0, uart0: 20, uart1: 21 };

export const PIN_COUNT = 30;
export const FLASH_SIZE = 2 * 1024 * 1024;
export const FLASH_SECTOR = 4096;
export const FLASH_PAGE = 256;
