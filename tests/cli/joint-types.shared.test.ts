/** Skeletons of every joint type through `marrow pose`, against the reference. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { expectClose } from '../helpers/close.ts';
import { commandJson, type PoseJson } from '../helpers/command.ts';
import { conformance, describeShared } from '../helpers/shared.ts';

interface JointTypes {
  readonly tolerance: number;
  readonly cases: readonly {
    readonly name: string;
    readonly skel: string;
    readonly sets: readonly {
      readonly root_translation: readonly number[];
      readonly dofs: readonly number[];
      readonly world: readonly (readonly number[])[];
    }[];
  }[];
}

let folder = '';
beforeAll(() => {
  folder = mkdtempSync(join(tmpdir(), 'marrow-'));
});
afterAll(() => rmSync(folder, { recursive: true }));

describeShared('marrow pose of every joint type, against the reference', () => {
  const { tolerance, cases } = conformance<JointTypes>('joint-types.json');
  it.each(cases)('marrow pose gives $name as the reference has it', async ({ skel, sets }) => {
    writeFileSync(join(folder, 'case.skel'), skel);
    for (const { root_translation: root, dofs, world } of sets) {
      const given = ['pose', 'case.skel', `--root=${root.join(',')}`, `--dofs=${dofs.join(',')}`];
      const { characters, diagnostics } = await commandJson<PoseJson>(given, folder);
      expect(diagnostics.filter((d) => d.severity !== 'info')).toEqual([]);
      const posed = characters[0].joints;
      expect(posed.map(({ type }) => type)).toEqual(skel.match(/[a-z]+joint(?= )/g));
      expectClose(
        posed.flatMap((joint) => joint.world),
        world.flat(),
        tolerance,
      );
    }
  });
});
