/**
 * A boot ROM of our own. Its tables are laid out as in the RP2040's mask ROM (datasheet, section
 * 2.8.2), so that firmware finds its functions; each function is `BKPT n; BX LR`, and the work is
 * done here when the core reaches the BKPT.
 */
import { Fault } from './fault.js';
import { BOOT2_RUN_ADDRESS, FLASH_PAGE, FLASH_SECTOR, ROM_SIZE, SRAM_BASE } from './map.js';
import { CHIP_SELECT } from './ssi.js';

const INITIAL_SP = 0x2004_1f00;
const FUNCTION_TABLE = 0x200;
const DATA_TABLE = 0x300;
const FUNCTIONS = 0x400;
const BX_LR = 0x4770;
const BOOT2_CODE_SIZE = 252;

/** Numbers of the BKPTs outside the function table. */
const CALL = { reset: 0, lookUp: 1, fault: 2 };
const FIRST_FUNCTION = 16;

/** The functions, by the two letters under which firmware looks them up (datasheet, section 2.8.3). */
export const ROM_FUNCTIONS = {
  P3: popCount,
  R3: reverse,
  L3: countLeadingZeros,
  T3: countTrailingZeros,
  MS: fill,
  S4: fill,
  MC: copy,
  C4: copy,
  IF: connectFlash,
  EX: exitXip,
  RE: erase,
  RP: program,
  FC: flushCache,
  CX: enterXip,
  UB: resetToUsbBoot,
};
const CODES = Object.keys(ROM_FUNCTIONS);

/** @returns {Uint32Array} the 16 kB of the ROM */
export function buildBootRom() {
  const view = new DataView(new ArrayBuffer(ROM_SIZE));
  const put16 = (address, value) => view.setUint16(address, value, true);
  const service = (address, number) => {
    put16(address, 0xbe00 | number);
    put16(address + 2, BX_LR);
    return address | 1;
  };
  view.setUint32(0x00, INITIAL_SP, true);
  view.setUint32(0x04, service(0x100, CALL.reset), true);
  view.setUint32(0x08, service(0x108, CALL.fault), true); // NMI
  view.setUint32(0x0c, 0x108 | 1, true); // HardFault
  view.setUint32(0x10, 0x0201_754d, true); // "Mu", 1, version 2
  put16(0x14, FUNCTION_TABLE);
  put16(0x16, DATA_TABLE);
  put16(0x18, service(0x104, CALL.lookUp));
  CODES.forEach((code, i) => {
    put16(FUNCTION_TABLE + 4 * i, code.charCodeAt(0) | (code.charCodeAt(1) << 8));
    put16(FUNCTION_TABLE + 4 * i + 2, service(FUNCTIONS + 4 * i, FIRST_FUNCTION + i));
  });
  return new Uint32Array(view.buffer);
}

/**
 * What the services need of their board.
 * @typedef {object} RomHost
 * @property {import('./chip.js').Chip} chip
 * @property {import('./w25q.js').W25q} flash
 * @property {(untilNs: number) => void} stall the core does nothing until then
 * @property {(reason: string) => void} halt the core does nothing until the next reset
 */

/**
 * Does the work of the service which the core has reached.
 * @param {RomHost} host
 * @param {number} number of the BKPT
 */
export function serveRom(host, number) {
  const { core } = host.chip;
  if (number === CALL.reset) boot(host);
  else if (number === CALL.lookUp) lookUp(core.registers, host.chip);
  else if (number === CALL.fault) host.halt('fault before the firmware had a vector table');
  else ROM_FUNCTIONS[CODES[number - FIRST_FUNCTION]](host, core.registers);
}

/** The way from reset to the second-stage bootloader, which runs from the end of SRAM. */
function boot(host) {
  const { chip, flash } = host;
  if (flash.busy) return again(host, flash.busyUntil); // the ROM tries for half a second
  chip.ssi.enterSerialMode();
  const boot2 = flash.bytes.slice(0, FLASH_PAGE);
  const stored = new DataView(boot2.buffer).getUint32(BOOT2_CODE_SIZE, true);
  if (crc32(boot2.subarray(0, BOOT2_CODE_SIZE)) !== stored) {
    return host.halt('no valid second-stage bootloader in flash: waiting for USB');
  }
  chip.sram.set(boot2, BOOT2_RUN_ADDRESS - SRAM_BASE);
  chip.core.registers[14] = 0;
  chip.core.registers[15] = BOOT2_RUN_ADDRESS;
}

/** `rom_table_lookup(table, code)`: 0 if the code is not in the table. */
function lookUp(r, chip) {
  const code = r[1] & 0xffff;
  for (let entry = r[0] & 0xffff; ; entry += 4) {
    const found = chip.readUint16(entry);
    if (found === 0 || found === code) {
      r[0] = found ? chip.readUint16(entry + 2) : 0;
      if (!found) chip.events.onWarning('ROM', `no function ${String.fromCharCode(code & 255, code >> 8)}`);
      return;
    }
  }
}

function popCount(_, r) {
  let count = 0;
  for (let rest = r[0]; rest; rest &= rest - 1) count++;
  r[0] = count;
}

function reverse(_, r) {
  let reversed = 0;
  for (let i = 0; i < 32; i++) reversed |= ((r[0] >>> i) & 1) << (31 - i);
  r[0] = reversed;
}

function countLeadingZeros(_, r) {
  r[0] = Math.clz32(r[0]);
}

function countTrailingZeros(_, r) {
  r[0] = r[0] ? 31 - Math.clz32(r[0] & -r[0]) : 32;
}

/** `memset(destination, byte, count)`; returns the destination. */
function fill({ chip }, r) {
  for (let i = 0; i < r[2] >>> 0; i++) chip.core.store8(r[0] + i, r[1] & 0xff);
}

/** `memcpy(destination, source, count)`; returns the destination. */
function copy({ chip }, r) {
  for (let i = 0; i < r[2] >>> 0; i++) chip.core.store8(r[0] + i, chip.core.load8(r[1] + i));
}

function connectFlash() {}

/** `flash_exit_xip`: back to serial commands. */
function exitXip({ chip }) {
  chip.ssi.enterSerialMode();
}

/** `flash_range_erase(address, count, block_size, block_command)`: one sector or block at a time. */
function erase(host, r) {
  const { flash } = host;
  if (!readyForCommands(host)) return;
  if (r[1] === 0) return;
  const block = r[2] >>> 0;
  const useBlock = block === 0x1_0000 && r[0] % block === 0 && r[1] >>> 0 >= block;
  const length = useBlock ? block : FLASH_SECTOR;
  const operation = flash.erase(r[0] >>> 0, length);
  if (!operation) return;
  r[0] += length;
  r[1] = Math.max(0, r[1] - length);
  again(host, operation.endNs);
}

/** `flash_range_program(address, data, count)`: one page at a time. */
function program(host, r) {
  const { chip, flash } = host;
  if (!readyForCommands(host)) return;
  if (r[2] === 0) return;
  const page = Uint8Array.from({ length: FLASH_PAGE }, (_, i) => chip.core.load8(r[1] + i));
  const operation = flash.program(r[0] >>> 0, page);
  if (!operation) return;
  r[0] += FLASH_PAGE;
  r[1] += FLASH_PAGE;
  r[2] = Math.max(0, r[2] - FLASH_PAGE);
  again(host, operation.endNs);
}

/** Also gives chip select back to the hardware. */
function flushCache({ chip }) {
  chip.ssi.forceChipSelect(CHIP_SELECT.normal);
}

function enterXip({ chip }) {
  chip.ssi.enterXipMode();
}

function resetToUsbBoot(host) {
  host.halt('firmware asked for the USB bootloader');
}

/** Waits for what the flash is doing; commands while it is mapped for reading would be lost. */
function readyForCommands(host) {
  const { chip, flash } = host;
  if (chip.ssi.xip && chip.strict) throw new Fault('flash command while XIP is on', undefined, { fatal: true });
  if (!flash.busy) return true;
  again(host, flash.busyUntil);
  return false;
}

/** Comes back to the same BKPT later: a reset or a power cut may come between. */
function again(host, untilNs) {
  host.chip.core.registers[15] -= 2;
  host.stall(untilNs);
}

const CRC_TABLE = Uint32Array.from({ length: 256 }, (_, i) => {
  let crc = i << 24;
  for (let bit = 0; bit < 8; bit++) crc = crc & 0x8000_0000 ? (crc << 1) ^ 0x04c1_1db7 : crc << 1;
  return crc;
});

/** CRC-32/MPEG-2, by which the boot ROM checks the second-stage bootloader. */
export function crc32(bytes) {
  let crc = 0xffff_ffff;
  for (const byte of bytes) crc = (crc << 8) ^ CRC_TABLE[(crc >>> 24) ^ byte];
  return crc >>> 0;
}
