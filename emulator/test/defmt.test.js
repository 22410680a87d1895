import assert from 'node:assert/strict';
import { chmodSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { decodeFrames, findDefmtPrint } from '../src/defmt.js';
import { UsageError } from '../src/fault.js';
import { echoingDefmtPrint, executable } from './support/defmt-print.js';

function folder(t) {
  const path = mkdtempSync(join(tmpdir(), 'defmt-'));
  t.after(() => rmSync(path, { recursive: true }));
  return path;
}

function tool(path) {
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, '#!/bin/sh\n');
  chmodSync(path, 0o755);
  return path;
}

test('DEFMT_PRINT is first, then the tools of the repository, then the PATH', (t) => {
  const root = folder(t);
  const named = tool(join(root, 'named'));
  const onPath = tool(join(root, 'path', 'defmt-print'));
  assert.equal(findDefmtPrint({ PATH: dirname(onPath) }, root), onPath);
  const ours = tool(join(root, '.tools', 'bin', 'defmt-print'));
  assert.equal(findDefmtPrint({ PATH: dirname(onPath) }, root), ours);
  assert.equal(findDefmtPrint({ PATH: dirname(onPath), DEFMT_PRINT: named }, root), named);
});

test('a missing defmt-print is told with the mend', (t) => {
  const root = folder(t);
  assert.throws(() => findDefmtPrint({ PATH: root }, root), /run script\/test once/);
  assert.throws(() => findDefmtPrint({ DEFMT_PRINT: join(root, 'no') }, root), UsageError);
});

test('lines come in the order of their frames, and what is no frame leaves a gap in its place', (t) => {
  const fake = echoingDefmtPrint(t);
  const frames = ['one', 'bad', 'two', 'three'].map((text) => Buffer.from(text));
  const lines = decodeFrames('some.elf', frames, fake);
  assert.deepEqual(lines[0], { timeUs: 1_000_002, level: 'INFO', text: 'one', module: 'plc::scan' });
  assert.deepEqual(lines.map((line) => line?.text), ['one', undefined, 'two', 'three']);
});

test('a defmt-print that fails is told with its own words', (t) => {
  const fake = executable(t, '#!/bin/sh\necho no such section >&2\nexit 1\n');
  assert.throws(() => decodeFrames('some.elf', [Buffer.of(1)], fake), /failed: no such section/);
});
