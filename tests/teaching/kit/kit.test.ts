/** The test kit: that its files tell every known mistake apart, and that its answers are right. */
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { CATALOGUE } from '../../../src/teaching/catalogue/all.ts';
import { characterOf, type SetAnswers, tellsApart } from '../../../src/teaching/kit/answers.ts';
import { KIT_SETS, kitFiles } from '../../../src/teaching/kit/files.ts';
import { command, commandJson } from '../../helpers/command.ts';

let folder = '';
let sets: readonly SetAnswers[] = [];
beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
  expect(await command(['kit', 'kit'], folder)).toMatchObject({ code: 0, err: '' });
  sets = JSON.parse(readFileSync(join(folder, 'kit/answers.json'), 'utf8')).sets;
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

describe('the test kit', () => {
  it('tells every known mistake apart, each way to make it', () => {
    const files = kitFiles();
    const kit = KIT_SETS.map((set) => ({ set, character: characterOf(set.files, files) }));
    const missed = CATALOGUE.flatMap(({ code, variants }) =>
      variants
        .filter((variant) => !kit.some(({ set, character }) => tellsApart(set, character, variant)))
        .map(({ detail }) => `${code} ${detail}`),
    );
    expect(missed).toEqual([]);
    const told = new Set(sets.flatMap(({ tells }) => tells));
    expect(CATALOGUE.map(({ code }) => code).filter((code) => !told.has(code))).toEqual([]);
  });

  it('has an error in no file', async () => {
    const { files, diagnostics } = await commandJson<{
      readonly files: readonly { readonly name: string; readonly loaded: boolean }[];
      readonly diagnostics: readonly { readonly severity: string; readonly file: string }[];
    }>(['info', 'kit'], folder);
    const own = files.filter(({ name }) => !/answers|README/.test(name));
    expect(own.map(({ name }) => name.replace('kit/', '')).sort()).toEqual([...kitFiles().keys()].sort());
    expect(own.filter(({ loaded }) => !loaded)).toEqual([]);
    expect(diagnostics.filter(({ severity }) => severity === 'error')).toEqual([]);
  });

  it.each(KIT_SETS)(
    'has the answers that pose and channels print: $name',
    async ({ name, files, times, channelTimes }) => {
      const answers = sets.find((set) => set.name === name);
      const paths = files.map((file) => `kit/${file}`);
      expect(answers?.frames ?? []).toHaveLength(times.length);
      for (const [i, time] of times.entries()) {
        const options = time === undefined ? [] : [`--time=${time}`];
        const { out } = await command(['pose', ...paths, ...options, '--vertices', '--json'], folder);
        const [{ joints, positions, normals }] = JSON.parse(out).characters;
        const frame = answers?.frames?.[i];
        const close = (found: readonly number[] = [], expected: readonly number[] = []) => {
          expect(found).toHaveLength(expected.length);
          const worst = found.reduce((most, value, k) => Math.max(most, Math.abs(value - expected[k])), 0);
          expect(worst).toBeLessThan(1e-12);
        };
        close(
          frame?.joints.flatMap(({ world, local }) => [...world, ...local]),
          joints.flatMap(({ world, local }: { world: number[]; local: number[] }) => [...world, ...local]),
        );
        close(frame?.vertices?.flat(), positions);
        close(frame?.normals?.flat(), normals);
      }
      if (channelTimes.length > 0) {
        const { out } = await command(['channels', ...paths, `--times=${channelTimes.join(',')}`, '--json'], folder);
        const { channels } = JSON.parse(out);
        answers?.channels?.values.forEach((values, c) => {
          values.forEach(
            (value, i) => void expect(value, `channel ${c} at ${channelTimes[i]}`).toBeCloseTo(channels[c][i], 12),
          );
        });
      }
    },
  );

  it('has the same numbers as text, for languages without JSON', () => {
    const lines = readFileSync(join(folder, 'kit/answers.txt'), 'utf8').trim().split('\n').slice(1);
    const count = sets.flatMap(({ frames = [], channels }) => [
      ...frames.map(({ joints, vertices = [] }) => 2 * joints.length + 2 * vertices.length),
      channels ? channels.times.length * channels.values.length : 0,
    ]);
    expect(lines).toHaveLength(count.reduce((a, b) => a + b, 0));
    const row = lines
      .find((line) => line.startsWith('morphs 1.2 vertex 3 '))
      ?.split(' ')
      .slice(4)
      .map(Number);
    expect(row).toEqual(sets.find(({ name }) => name === 'morphs')?.frames?.[1].vertices?.[3]);
  });

  it('has a README with what each set tells apart', () => {
    const text = readFileSync(join(folder, 'kit/README.md'), 'utf8');
    for (const { name, tells } of sets) {
      expect(text).toContain(`### ${name}\n`);
      for (const code of tells) expect(text).toContain(`\`${code}\``);
    }
    for (const language of ['C++', 'Java', 'Python', 'JavaScript']) expect(text).toContain(`\n${language}, with `);
  });

  it.each([
    ['passes with the right numbers', 0, 0, '6 joints agree'],
    ['fails with a wrong one', 0.001, 1, 'trunk, number 0'],
    ['fails with what is no number', Number.NaN, 1, 'trunk, number 0'],
  ])('has a README whose JavaScript %s', async (_, off, code, told) => {
    const text = readFileSync(join(folder, 'kit/README.md'), 'utf8');
    const [, program] = /```js\n(.*?)```/s.exec(text) ?? [];
    writeFileSync(join(folder, 'kit/check.mjs'), program ?? '');
    const worlds = sets[0].frames?.[0].joints.map(({ world }) => world.map((x) => x + off)) ?? [];
    const list = JSON.stringify(worlds).replaceAll('null', 'NaN');
    writeFileSync(join(folder, 'kit/mine.mjs'), `const all = ${list};\nexport const worldOf = (j) => all[j];\n`);
    const ran = spawnSync(process.execPath, ['check.mjs'], { cwd: join(folder, 'kit'), encoding: 'utf8' });
    expect([ran.status, ran.stdout + ran.stderr]).toEqual([code, expect.stringContaining(told)]);
  });

  it('replaces files only when told to', async () => {
    writeFileSync(join(folder, 'kit/tree.skel'), 'mine');
    expect(await command(['kit', 'kit'], folder)).toMatchObject({ code: 1, out: '' });
    expect(readFileSync(join(folder, 'kit/tree.skel'), 'utf8')).toBe('mine');
    expect((await command(['kit', 'kit', '--force'], folder)).code).toBe(0);
    expect(readFileSync(join(folder, 'kit/tree.skel'), 'utf8')).toBe(kitFiles().get('tree.skel'));
    expect((await command(['kit', 'kit/tree.skel'], folder)).code).toBe(3);
    expect((await command(['kit'], folder)).code).toBe(2);
  });
});
