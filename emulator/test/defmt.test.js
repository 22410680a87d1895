import assert from 'node:assert/strict';
import { chmodSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { decodeFrames, findDefmtPrint } from '../src/defmt.js';
import { UsageError } from '../src/fault.js';

function folder(t) {
  const path = mkdtempSync(join(tmpdir(), 'defmt-'));
  t.after(() => rmSync(path, { recursive: true }));
  return path;
}

function tool(path, script = '#!/bin/sh\n') {
  mkdirSync(dirname(path), { recursive: true });
  writeFileSync(path, script);
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

/** Prints one JSON line for each frame of its input that is not `bad`, as defmt-print does. */
const FAKE = `#!/usr/bin/env node
console.log(JSON.stringify({ schema_version: 1 }));
for (const frame of require('node:fs').readFileSync(0, 'latin1').split('\\0').slice(0, -1)) {
  if (frame === 'bad') continue;
  const location = { module_path: { crate_name: 'plc', modules: ['scan'] } };
  console.log(JSON.stringify({ data: frame, level: 'INFO', target_timestamp: '1.000002', location }));
}
`;

test('lines come in the order of their frames, and what is no frame leaves a gap in its place', (t) => {
  const fake = tool(join(folder(t), 'fake.cjs'), FAKE);
  const frames = ['one', 'bad', 'two', 'three'].map((text) => Buffer.from(text));
  const lines = decodeFrames('some.elf', frames, fake);
  assert.deepEqual(lines[0], { timeUs: 1_000_002, level: 'INFO', text: 'one', module: 'plc::scan' });
  assert.deepEqual(lines.map((line) => line?.text), ['one', undefined, 'two', 'three']);
});

test('a defmt-print that fails is told with its own words', (t) => {
  const fake = tool(join(folder(t), 'fake'), '#!/bin/sh\necho no such section >&2\nexit 1\n');
  assert.throws(() => decodeFrames('some.elf', [Buffer.of(1)], fake), /failed: no such section/);
});
