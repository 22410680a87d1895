import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { image, temporaryFile } from './support/image.js';
import { blink, Program } from './support/programs.js';

const PICO = fileURLToPath(new URL('../bin/pico.mjs', import.meta.url));

function pico(...args) {
  const { status, stdout, stderr } = spawnSync(process.execPath, [PICO, ...args], { encoding: 'utf8' });
  return { status, stdout, stderr };
}

test('--help teaches and succeeds', () => {
  const { status, stdout } = pico('--help');
  assert.equal(status, 0);
  for (const word of ['Usage:', '--for MS', '--set PIN=LEVEL@MS', 'Examples:', 'Exit status:']) {
    assert.ok(stdout.includes(word), word);
  }
});

test('edges are printed with their times, in order', (t) => {
  const { status, stdout } = pico(image(t, blink()), '--for', '4');
  assert.equal(status, 0);
  const lines = stdout.trimEnd().split('\n');
  assert.match(lines[0], /^ {4}0\.000000 {2}boot power-on$/);
  assert.match(lines[1], /^ {4}0\.00000\d {2}pin 25 = 0$/);
  assert.match(lines[2], /^ {4}0\.0010\d\d {2}pin 25 = 1$/);
  assert.equal(lines.length, 5);
});

test('inputs are set at their times', (t) => {
  const echo = new Program().output(25).label('again').load(0, 0xd000_0004).ldr(1, 0);
  const copy = echo.emit(0x05c9).load(0, 0xd000_0010).str(1, 0).b('again'); // LSLS r1, r1, #23
  const { stdout } = pico(image(t, copy.bytes()), '--for', '3', '--set', '2=1@1', '--set', '2=0@2');
  assert.match(stdout, /0\.001000 {2}pin 25 = 1\n +0\.002000 {2}pin 25 = 0\n$/);
});

test('the flash is loaded from its file and saved to it', (t) => {
  const file = temporaryFile(t, 'flash.bin');
  const elf = image(t, new Program().erase(0x8000).program(0x8000, 0x2000_0000).stop().bytes());
  assert.equal(pico(elf, '--for', '100', '--flash', file).status, 0);
  const first = readFileSync(file);
  assert.ok(first.subarray(0x8000, 0x8100).some((byte) => byte !== 0xff));
  pico(elf, '--for', '100', '--flash', file, '--seed', '9');
  assert.notDeepEqual(readFileSync(file).subarray(0x8000, 0x8100), first.subarray(0x8000, 0x8100));
});

test('a fault is told with its place and fails', (t) => {
  const { status, stdout } = pico(image(t, new Program().emit(0xde00).bytes()), '--for', '1');
  assert.equal(status, 1);
  assert.match(stdout, /fault: undefined instruction, pc 0x20041f00/);
});

test('a cut is told', (t) => {
  const { stdout } = pico(image(t, blink()), '--for', '200', '--cut', '20', '--pins', 'none');
  assert.match(stdout, /0\.020000 {2}power cut\n +0\.120000 {2}boot power-on/);
});

test('wrong usage gets one clear line and status 2', (t) => {
  const elf = image(t, blink());
  for (const args of [
    [],
    [elf, elf],
    ['/no/such/file'],
    [PICO],
    [elf, '--bogus'],
    [elf, '--for'],
    [elf, '--for', 'ever'],
    [elf, '--set', '2=5'],
    [elf, '--set', '99=1'],
    [elf, '--set', '99=1@5'],
    [elf, '--pins', 'all'],
    [elf, '--analog', '7=1'],
    [elf, '--for', '1', '--flash', '/no/such/folder/flash.bin'],
  ]) {
    const { status, stderr } = pico(...args);
    assert.equal(status, 2, `${args}`);
    assert.match(stderr, /^error: [^\n]+\n$/, `${args}`);
  }
});
