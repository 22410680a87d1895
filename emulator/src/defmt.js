/**
 * Turns defmt frames into text by way of `defmt-print`, the tool of the defmt project, which reads
 * the format strings out of the ELF file.
 */
import { spawnSync } from 'node:child_process';
import { accessSync, constants, statSync } from 'node:fs';
import { delimiter, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { UsageError } from './fault.js';

const REPOSITORY = fileURLToPath(new URL('../../', import.meta.url));
const MAX_OUTPUT = 1 << 28;

/**
 * @typedef {object} LogLine
 * @property {number | null} timeUs the firmware's own time stamp, in microseconds since it started
 * @property {string} level TRACE, DEBUG, INFO, WARN or ERROR; empty for `println!`
 * @property {string} text
 * @property {string} module path of the module that spoke, such as `plc::retain`
 */

/**
 * Where `defmt-print` is: DEFMT_PRINT, else `.tools/bin` of the repository, else the PATH.
 * @param {Record<string, string | undefined>} [environment]
 * @param {string} [repository]
 * @throws {UsageError} if it is nowhere
 */
export function findDefmtPrint(environment = process.env, repository = REPOSITORY) {
  if (environment.DEFMT_PRINT) {
    if (isExecutable(environment.DEFMT_PRINT)) return environment.DEFMT_PRINT;
    throw new UsageError(`DEFMT_PRINT names ${environment.DEFMT_PRINT}, which cannot be run`);
  }
  const folders = [join(repository, '.tools', 'bin'), ...(environment.PATH ?? '').split(delimiter)];
  const found = folders
    .filter(Boolean)
    .map((folder) => join(folder, 'defmt-print'))
    .find(isExecutable);
  if (found) return found;
  throw new UsageError('defmt-print is not installed: run script/test once, which installs it');
}

/**
 * @param {string} elfPath the firmware that wrote the frames
 * @param {Uint8Array[]} frames
 * @param {string} [tool]
 * @returns {(LogLine | null)[]} one for each frame; null for what is not a frame of this firmware
 */
export function decodeFrames(elfPath, frames, tool = findDefmtPrint()) {
  if (!frames.length) return [];
  const lines = print(elfPath, frames, tool);
  if (lines.length === frames.length) return lines;
  if (frames.length === 1) return [null];
  // Something in between was no frame: find it by halves.
  const half = frames.length >> 1;
  return [
    ...decodeFrames(elfPath, frames.slice(0, half), tool),
    ...decodeFrames(elfPath, frames.slice(half), tool),
  ];
}

function print(elfPath, frames, tool) {
  const input = Buffer.concat(frames.flatMap((frame) => [frame, Uint8Array.of(0)]));
  const result = spawnSync(tool, ['-e', elfPath, '--json', 'stdin'], {
    input,
    encoding: 'utf8',
    maxBuffer: MAX_OUTPUT,
  });
  if (result.error && result.error.code !== 'EPIPE') throw new UsageError(`cannot run ${tool}: ${result.error.message}`);
  // A tool that gives up before it has read all input says why by itself.
  if (result.status !== 0) throw new UsageError(`${tool} failed: ${result.stderr.trim()}`);
  return result.stdout
    .split('\n')
    .filter(Boolean)
    .map((line) => JSON.parse(line))
    .filter((entry) => 'data' in entry)
    .map(toLogLine);
}

function toLogLine({ data, level, target_timestamp: stamp, location }) {
  const path = location?.module_path;
  return {
    timeUs: toMicros(stamp),
    level: level ?? '',
    text: data,
    module: path ? [path.crate_name, ...path.modules].join('::') : '',
  };
}

/** `{=u64:us}` is printed in seconds with six decimals. */
function toMicros(stamp) {
  const seconds = /^(\d+)\.(\d{6})$/.exec(stamp ?? '');
  return seconds ? Number(seconds[1]) * 1e6 + Number(seconds[2]) : null;
}

function isExecutable(path) {
  try {
    accessSync(path, constants.X_OK);
    return statSync(path).isFile();
  } catch {
    return false;
  }
}
