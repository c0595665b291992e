import { describe, expect, it } from 'vitest';
import { readWhole } from '../../src/formats/reader.ts';
import { setsReader } from '../../src/formats/sets/read.ts';
import { writeSets } from '../../src/formats/sets/write.ts';

const read = (value: unknown) =>
  readWhole(setsReader('hero.sets.json'), typeof value === 'string' ? value : JSON.stringify(value));

describe('selection sets and locks in a file', () => {
  it('sets and locks are read, and what is not known is told, kept and written back', () => {
    const given = {
      sets: [{ name: 'arm', color: '#4a90e2', joints: ['arm_l', '#7'], icon: { of: ['hand'] } }],
      locked: [{ joint: 'shin_l', dofs: ['ry'], why: null }],
      version: 2,
    };
    const { value, diagnostics } = read(given);
    expect(value).toEqual({
      sets: [{ name: 'arm', color: '#4a90e2', joints: ['arm_l', '#7'], others: { icon: { of: ['hand'] } } }],
      locked: [{ joint: 'shin_l', dofs: ['ry'], others: { why: null } }],
      others: { version: 2 },
    });
    expect(diagnostics.map(({ severity, code, message }) => `${severity} ${code} ${message}`)).toEqual([
      'info field-unknown sets[0].icon is not known here.',
      'info field-unknown locked[0].why is not known here.',
      'info field-unknown version is not known here.',
    ]);
    expect(value && JSON.parse(writeSets(value).text)).toEqual(given);
  });

  it('either list may be absent', () => {
    expect(read({ sets: [] }).value).toEqual({ sets: [], locked: [] });
    expect(read({ locked: [] }).value).toEqual({ sets: [], locked: [] });
  });

  it.each([
    ['[]', 'sets-wrong', 'Expected an object, found a list of 0.'],
    ['{}', 'sets-wrong', 'Expected { "sets": […], "locked": […] }, found an object.'],
    ['{"sets": 3}', 'sets-wrong', 'sets: expected a list, found 3.'],
    ['{"sets": [null]}', 'sets-wrong', 'sets[0]: expected an object, found null.'],
    ['{"sets": [{"joints": []}]}', 'sets-wrong', 'sets[0].name: expected text, found nothing.'],
    ['{"sets": [{"name": "a"}]}', 'sets-wrong', 'sets[0].joints: expected a list, found nothing.'],
    ['{"sets": [{"name": "a", "joints": [7]}]}', 'sets-wrong', 'sets[0].joints[0]: expected text, found 7.'],
    ['{"sets": [{"name": "a", "color": 7, "joints": []}]}', 'sets-wrong', 'sets[0].color: expected text, found 7.'],
    ['{"locked": [{"joint": "a"}]}', 'sets-wrong', 'locked[0].dofs: expected a list, found nothing.'],
    [`{"sets": [], "deep": ${'['.repeat(100)}${']'.repeat(100)}}`, 'json-wrong', 'up to 64 times'],
  ])('%s is an error that names the value', (text, code, message) => {
    const { value, diagnostics } = read(text);
    expect(value).toBeUndefined();
    expect(diagnostics).toHaveLength(1);
    expect(diagnostics[0]).toMatchObject({ severity: 'error', code, message: expect.stringContaining(message) });
  });

  it('text that is no JSON is an error at its place', () => {
    const { diagnostics } = read('{\n  "sets": [],\n  "locked": []\n  "more": 1\n}');
    expect(diagnostics[0]).toMatchObject({ severity: 'error', code: 'json-wrong', line: 4 });
  });
});
