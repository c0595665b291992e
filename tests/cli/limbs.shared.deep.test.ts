/** Limbs on the command line, against the reference's numbers. */
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, expect, it } from 'vitest';
import { expectClose } from '../helpers/close.ts';
import { command, commandJson, type PoseJson } from '../helpers/command.ts';
import { conformance, describeShared, sharedPath } from '../helpers/shared.ts';

const folder = mkdtempSync(join(tmpdir(), 'marrow-limbs-'));
afterAll(() => rmSync(folder, { recursive: true, force: true }));

interface Craft {
  readonly tolerance: number;
  readonly limbs: readonly LimbsCase[];
  readonly diagnostics: readonly DiagnosticCase[];
}
interface LimbsCase {
  readonly files: readonly string[];
  readonly take_file: string;
  readonly size: number;
  readonly range: readonly [number, number];
  readonly flattened: readonly Frame[];
  readonly frames: readonly (Frame & { readonly limbs: readonly LimbRow[] })[];
}
interface Frame {
  readonly time: number;
  readonly world: readonly (readonly number[])[];
}
interface LimbRow {
  readonly name: string;
  readonly blend: number;
  readonly space: string;
  readonly goal: readonly number[];
  readonly gap: number;
  readonly match: { readonly goal: readonly number[]; readonly pole: readonly number[]; readonly bend: number };
}
interface DiagnosticCase {
  readonly files: readonly string[];
  readonly code: string;
  readonly severity: string;
  readonly says?: string;
}
type LimbsJson = PoseJson & {
  readonly characters: readonly (PoseJson['characters'][number] & { readonly limbs: readonly LimbRow[] })[];
};

const isOfLimbs = ({ files }: { readonly files: readonly string[] }) => files.some((f) => f.endsWith('.limbs.json'));

describeShared('limbs of the reference files', () => {
  const craft = conformance<Craft>('craft.json');
  const shared = sharedPath('');

  it.each(craft.limbs.map((one) => ({ ...one, name: one.take_file })))(
    '$name has the reference’s poses, gaps and matches',
    async ({ files, frames }) => {
      const times = frames.map(({ time }) => time).join(',');
      const found = await commandJson<{ readonly frames: readonly LimbsJson[] }>(
        ['pose', ...files, '--times', times],
        shared,
      );
      frames.forEach(({ time, world, limbs }, f) => {
        const [character] = found.frames[f].characters;
        expect(character.limbs.map(({ name }) => name).sort()).toEqual(limbs.map(({ name }) => name).sort());
        for (const limb of limbs) {
          const own = character.limbs.find(({ name }) => name === limb.name);
          expect(own).toMatchObject({ space: limb.space });
          const numbers = ({ blend, goal, gap, match }: LimbRow) => [
            ...[blend, gap, ...goal],
            ...[...match.goal, ...match.pole, match.bend],
          ];
          expectClose(numbers(own ?? limb), numbers(limb), craft.tolerance, `${limb.name} at ${time}`);
        }
        expectClose(
          character.joints.flatMap((joint) => joint.world),
          world.flat(),
          craft.tolerance,
          `world at ${time}`,
        );
      });
    },
  );

  it.each(craft.limbs.map((one) => ({ ...one, name: one.take_file })))(
    '$name is written as a plain .anim that plays the same at whole frames',
    async ({ files, flattened, size }) => {
      const out = join(folder, 'plain.anim');
      expect((await command(['convert', ...files, out], shared)).code).toBe(0);
      const times = flattened.map(({ time }) => time).join(',');
      const skel = files.filter((name) => name.endsWith('.skel'));
      const found = await commandJson<{ readonly frames: readonly PoseJson[] }>(
        ['pose', ...skel, out, '--times', times],
        shared,
      );
      // Of each of up to four joints above, an angle within 0.001.
      flattened.forEach(({ time, world }, f) => {
        const own = found.frames[f].characters[0].joints.flatMap((joint) => joint.world);
        expectClose(own, world.flat(), 4e-3 * Math.max(1, size), `world at ${time}`);
      });
    },
  );

  it.each(craft.limbs.map((one) => ({ ...one, name: one.take_file })))(
    '$name is written as BVH with the solved limbs of each frame, and as GLB within 0.001 of its size',
    async ({ files, frames, size, range }) => {
      // Frames of the file.
      const times = [0, 0.5, 1, 1.5].filter((time) => time >= range[0] && time <= range[1]).join(',');
      const placesIn = async (given: readonly string[]) => {
        const found = await commandJson<{ readonly frames: readonly PoseJson[] }>(
          ['pose', ...given, '--times', times],
          shared,
        );
        return found.frames.map(({ characters: [{ joints }] }) =>
          Object.fromEntries(joints.map(({ name, world }) => [name, world.slice(12, 15)])),
        );
      };
      expect(frames.length).toBeGreaterThan(0);
      const solved = await placesIn(files);
      for (const [name, tolerance] of [
        ['solved.bvh', 1e-6],
        ['solved.glb', 1e-3],
      ] as const) {
        const out = join(folder, name);
        expect(
          (await command(['convert', ...files, out, ...(name.endsWith('.glb') ? ['--raw'] : [])], shared)).code,
        ).toBe(0);
        const written = await placesIn([out]);
        solved.forEach((places, f) => {
          // In GLB the root may be two nodes of one name.
          for (const [joint, place] of Object.entries(places).slice(1)) {
            expectClose(written[f][joint], place, tolerance * size, `${joint} in ${name}`);
          }
        });
      }
    },
  );

  it.each(craft.diagnostics.filter(isOfLimbs).map((one) => ({ ...one, name: one.files.at(-1) ?? '' })))(
    '$name tells $code',
    async ({ files, code, severity, says, name }) => {
      const args = ['pose', ...files, '--time', '0'];
      const found = await commandJson<PoseJson>(args, shared, severity === 'error' ? 1 : 0);
      const [first] = found.diagnostics.filter((d) => d.severity === severity || d.code === code);
      expect(first).toMatchObject({ code, severity, file: name });
      expect(first.message).toContain(says ?? '');
    },
  );
});
