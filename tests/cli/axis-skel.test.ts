/** Axis-angle `.skel` files on the command line. */
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { expectClose, WITHIN } from '../helpers/close.ts';
import { command, commandJson, type InfoJson, type PoseJson } from '../helpers/command.ts';
import { conformance, describeShared, sharedPath } from '../helpers/shared.ts';

interface AxisSkelFk {
  readonly files: readonly {
    readonly file: string;
    readonly joints: number;
    readonly reach: number;
    readonly sets: readonly { readonly angles: readonly number[]; readonly tips: readonly (readonly number[])[] }[];
  }[];
}

const ARM = '0.5 0 1 0 0 1\n1.5 1 0 0 30 1\n1 2 0 0 60 0\n';
const DATA = 'data/axis-skel';

let folder = '';
const put = (name: string, text: string) => writeFileSync(join(folder, name), text);
const text = (name: string) => readFileSync(join(folder, name), 'utf8');
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
});
afterAll(() => rmSync(folder, { recursive: true }));

describeShared('marrow pose of axis-angle skeletons, against the reference', () => {
  it.each(conformance<AxisSkelFk>('axis-skel-fk.json').files)(
    'marrow pose gives $file as the reference has it',
    async ({ file, joints, reach, sets }) => {
      for (const [set, { angles, tips }] of sets.entries()) {
        const dofs = set === 0 ? [] : [`--dofs=${angles.map((a) => (a * Math.PI) / 180).join(',')}`];
        const { characters, diagnostics } = await commandJson<PoseJson>(['pose', file, ...dofs], sharedPath(DATA));
        expect(diagnostics).toEqual([]);
        expect(characters[0].joints.map(({ type }) => type)).toEqual(new Array(joints).fill('hingejoint'));
        expectClose(
          characters[0].joints.flatMap(({ tip }) => tip ?? []),
          tips.flat(),
          1e-6 * reach,
        );
      }
    },
  );
});

describeShared('marrow info of axis-angle files with something wrong', () => {
  it.each(['missing-child', 'non-number', 'zero-axis'])(
    'marrow info refuses %s.axskel, with its line',
    async (stem) => {
      const { files, diagnostics } = await commandJson<InfoJson>(
        ['info', `${stem}.axskel`],
        sharedPath(`${DATA}/malformed`),
        1,
      );
      expect(files).toMatchObject([{ kind: 'skel', loaded: false }]);
      expect(diagnostics).toMatchObject([{ severity: 'error', file: `${stem}.axskel`, line: 2 }]);
    },
  );
});

describeShared('marrow convert of axis-angle files', () => {
  it.each(conformance<AxisSkelFk>('axis-skel-fk.json').files)(
    'marrow convert of $file there and back is the same bytes',
    async ({ file }) => {
      copyFileSync(sharedPath(`${DATA}/${file}`), join(folder, file));
      const convert = (...names: string[]) => command(['convert', ...names], folder);
      expect((await convert(file, 'same.axskel')).code).toBe(0);
      expect((await convert(file, 'tree.skel')).code).toBe(0);
      expect((await convert('tree.skel', 'back.axskel')).code).toBe(0);
      expect(text('tree.skel')).toMatch(/^hingejoint \{/);
      expect(text('back.axskel')).toBe(text('same.axskel'));
      expect(text('same.axskel')).toBe(text(file));
    },
  );
});

describe('the axis-angle form in the command', () => {
  it('prints axis-angle joints and DOFs, and tips as text', async () => {
    put('arm.axskel', ARM);
    const { files } = await commandJson<InfoJson>(['info', 'arm.axskel'], folder);
    const counts = { joints: 3, dofs: 3, roots: 1, form: 'axis-angle' };
    expect(files).toEqual([{ name: 'arm.axskel', kind: 'skel', loaded: true, ...counts }]);
    expect((await command(['pose', 'arm.axskel', '--dofs=0,0,0', '--root=1,0,0'], folder)).out).toContain('tip 1 2 0');
  });

  it('gives tips to joints with a length, and to no others', async () => {
    put('mixed.skel', 'balljoint a {\n pose 0 0 1.5707963267948966\n length 2\n balljoint b {\n }\n}\n');
    const [{ joints }] = (await commandJson<PoseJson>(['pose', 'mixed.skel'], folder)).characters;
    expectClose(joints[0].tip ?? [], [-2, 0, 0], WITHIN.rounding);
    expect(joints[1]).not.toHaveProperty('tip');
  });

  it('the axis-angle form in the command keeps the joint types of a .skel, and refuses what axis-angle files can not hold, saying why', async () => {
    put('arm.skel', ARM);
    put('ball.skel', 'balljoint a {\n}\n');
    put('two.skel', 'hingejoint {\n length 1\n}\nhingejoint {\n length 1\n}\n');
    expect((await command(['convert', 'arm.skel', 'again.skel'], folder)).code).toBe(0);
    expect(text('again.skel')).toBe(ARM);
    const refused = await command(['convert', 'ball.skel', 'ball.axskel'], folder);
    expect(refused.code).toBe(1);
    expect(refused.err).toContain('joint 0 "a" is not a hinge. Use .skel instead.');
    const two = await command(['convert', 'two.skel', 'two.axskel'], folder);
    expect(two.err).toContain('it holds one skeleton, and there are 2.');
  });

  it('axis-angle files become motion capture with End Sites at the tips', async () => {
    put('arm.axskel', ARM);
    expect((await command(['convert', 'arm.axskel', 'arm.bvh'], folder)).code).toBe(0);
    const [{ endSites = [] }] = (await commandJson<PoseJson>(['pose', 'arm.bvh'], folder)).characters;
    const [{ joints }] = (await commandJson<PoseJson>(['pose', 'arm.axskel'], folder)).characters;
    expect(endSites).toHaveLength(1);
    const posed = await commandJson<PoseJson>(['pose', 'arm.bvh', '--frame=0'], folder);
    expectClose(posed.characters[0].endSites?.[0].position ?? [], joints[2].tip ?? [], WITHIN.rounding);
  });
});
