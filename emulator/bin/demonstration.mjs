#!/usr/bin/env node
import { demonstrate } from '../src/demonstration.js';
import { UsageError } from '../src/fault.js';

const [elf, plc, ...rest] = process.argv.slice(2);
if (!elf || !plc || rest.length) {
  process.stderr.write('Usage: node emulator/bin/demonstration.mjs ELF PLC\n\n');
  process.stderr.write('Plays the demonstration on an emulated Pico. PLC is the soft PLC of the same sources.\n');
  process.exit(2);
}
try {
  process.stdout.write('an emulated Raspberry Pi Pico, simulated time\n');
  process.exitCode = (await demonstrate(elf, plc, (text) => process.stdout.write(text))) ? 0 : 1;
} catch (error) {
  if (!(error instanceof UsageError) && !error.syscall) throw error;
  process.stderr.write(`error: ${error.message}\n`);
  process.exitCode = 2;
}
