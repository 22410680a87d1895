// The boot line names the program, by a fingerprint that no machine has a part in.

import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Pico } from '../../emulator/src/index.js';
import { Application } from './support/application.js';

const named = ['hierarchy', 'rounds', 'values'].map((name) => Application.named(name));
const applications = [Application.flashed(), ...named, ...Application.random()];

const inHex = ({ symbols }) => symbols.fingerprint.toString(16).padStart(8, '0');

test('the boot line names the fingerprint that x86 gives the program', () => {
  for (const application of applications) {
    const pico = new Pico(application.image);
    pico.runFor(50);
    const [, name, fingerprint] = /^(\S+) ([0-9a-f]{8}), scan /.exec(pico.log[0]?.text) ?? [];
    assert.deepEqual([name, fingerprint], [application.symbols.application, inHex(application)]);
  }
});

test('no two programs have the same fingerprint', () => {
  assert.equal(new Set(applications.map(inHex)).size, applications.length);
});
