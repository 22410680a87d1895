/** A tool that answers like `defmt-print --json`, for frames that are plain text. */
import { chmodSync } from 'node:fs';
import { temporaryFile } from './image.js';

const ECHO = `#!/usr/bin/env node
console.log(JSON.stringify({ schema_version: 1 }));
for (const frame of require('node:fs').readFileSync(0, 'latin1').split('\\0').slice(0, -1)) {
  if (frame === 'bad') continue;
  const location = { module_path: { crate_name: 'plc', modules: ['scan'] } };
  console.log(JSON.stringify({ data: frame, level: 'INFO', target_timestamp: '1.000002', location }));
}
`;

/** @returns {string} the path of an executable with this text */
export function executable(test, text) {
  const path = temporaryFile(test, 'tool.cjs', text);
  chmodSync(path, 0o755);
  return path;
}

/** The tool: each frame is a line of its own text; the frame `bad` is none. */
export function echoingDefmtPrint(test) {
  return executable(test, ECHO);
}
