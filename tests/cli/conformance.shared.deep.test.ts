/** The reference files on the command line, at the reference's own tolerance. */
import { expect, it } from 'vitest';
import { expectClose, WITHIN } from '../helpers/close.ts';
import { type ChannelsJson, command, commandJson, type InfoJson, type PoseJson } from '../helpers/command.ts';
import { conformance, describeShared, sharedPath } from '../helpers/shared.ts';

type Triple = readonly number[];

interface Posed {
  readonly name?: string;
  readonly time?: number;
  readonly root_translation: Triple;
  readonly pose?: readonly Triple[];
  readonly clamped: readonly Triple[];
  readonly world?: readonly Triple[];
}

interface Deformed {
  readonly aabb: { readonly min: Triple; readonly max: Triple };
  readonly shortest_normal_sum: number;
  readonly vertices: readonly number[];
  readonly positions: readonly Triple[];
  readonly normals: readonly Triple[];
}

const SHARED = sharedPath('');

/** The first character of `marrow pose`. */
async function poseOf(files: readonly string[], options: readonly string[]): Promise<PoseJson['characters'][0]> {
  const { characters } = await commandJson<PoseJson>(['pose', ...files, ...options], SHARED);
  expect(characters).toHaveLength(1);
  return characters[0];
}

function expectSkin(character: PoseJson['characters'][0], expected: Deformed): void {
  const { positions = [], normals = [], bounds } = character;
  const listed = (list: readonly number[]) => expected.vertices.flatMap((v) => list.slice(3 * v, 3 * v + 3));
  expectClose(listed(positions), expected.positions.flat(), WITHIN.reference, 'positions');
  const relaxed = WITHIN.reference / Math.min(1, expected.shortest_normal_sum);
  expectClose(listed(normals), expected.normals.flat(), relaxed, 'normals');
  expectClose(bounds?.min ?? [], expected.aabb.min, WITHIN.reference, 'bounds, min');
  expectClose(bounds?.max ?? [], expected.aabb.max, WITHIN.reference, 'bounds, max');
}

function expectJoints(character: PoseJson['characters'][0], expected: Posed): void {
  const { joints, root } = character;
  expectClose(root, expected.root_translation, WITHIN.reference, 'root translation');
  expectClose(
    joints.flatMap((j) => j.dofs),
    expected.clamped.flat(),
    WITHIN.reference,
    'DOFs',
  );
  if (expected.world)
    expectClose(
      joints.flatMap((j) => j.world),
      expected.world.flat(),
      WITHIN.reference,
      'world',
    );
}

/** Options that set a pose; the pose named `file` is the file pose. */
function posing({ name, pose, root_translation }: Posed): string[] {
  const root = `--root=${root_translation.join(',')}`;
  return name === 'file' || !pose ? [root] : [root, '--dofs', pose.flat().join(',')];
}

describeShared('marrow pose, against the reference', () => {
  interface Skeletons {
    readonly skeletons: readonly {
      readonly skel: string;
      readonly names: readonly string[];
      readonly parents: readonly number[];
      readonly poses: readonly Posed[];
    }[];
  }
  for (const { skel, names, parents, poses } of conformance<Skeletons>('skel-fk.json').skeletons) {
    it(`marrow pose places every joint of ${skel}`, async () => {
      for (const expected of poses) {
        const character = await poseOf([skel], posing(expected));
        expect(character.joints.map((j) => j.name)).toEqual(names);
        expect(character.joints.map((j) => j.parent)).toEqual(parents);
        expect(character.joints.map((j) => j.index)).toEqual(names.map((_, i) => i));
        expect(new Set(character.joints.map((j) => j.type))).toEqual(new Set(['balljoint']));
        expectJoints(character, expected);
      }
    });
  }

  interface Skins {
    readonly cases: readonly {
      readonly skel: string;
      readonly skin: string;
      readonly poses: readonly (Posed & Deformed)[];
    }[];
  }
  for (const file of ['skin-deform.json', 'skin-many-influences.json']) {
    for (const { skel, skin, poses } of conformance<Skins>(file).cases) {
      it(`marrow pose deforms every vertex of ${skin}`, async () => {
        for (const expected of poses) {
          const character = await poseOf([skel, skin], ['--vertices', ...posing(expected)]);
          expectJoints(character, expected);
          expectSkin(character, expected);
        }
      });
    }
  }

  interface Animations {
    readonly cases: readonly {
      readonly skel: string;
      readonly skin?: string;
      readonly anim: string;
      readonly frames: readonly (Posed & Partial<Deformed>)[];
    }[];
  }
  for (const { skel, skin, anim, frames } of conformance<Animations>('anim-pose.json').cases) {
    it(`marrow pose plays ${anim} on ${skel}`, async () => {
      const files = [skel, ...(skin ? [skin] : []), anim];
      for (const expected of frames) {
        const character = await poseOf(files, ['--vertices', '--time', String(expected.time)]);
        expectJoints(character, expected);
        const { aabb, shortest_normal_sum, vertices, positions, normals } = expected;
        if (!skin || !aabb || !vertices || !positions || !normals) continue;
        expectSkin(character, { aabb, shortest_normal_sum: shortest_normal_sum ?? 1, vertices, positions, normals });
      }
    });
  }

  interface Morphs {
    readonly cases: readonly (Posed & {
      readonly skel: string;
      readonly skin: string;
      readonly morphs: readonly string[];
      readonly vertices: readonly number[];
      readonly blends: readonly (Omit<Deformed, 'vertices'> & {
        readonly weights: readonly number[];
        readonly blended_positions: readonly Triple[];
      })[];
    })[];
  }
  for (const { skel, skin, morphs, vertices, blends, ...posed } of conformance<Morphs>('morph.json').cases) {
    it(`marrow pose blends ${morphs.join(' and ')}, with a skeleton and without`, async () => {
      for (const expected of blends) {
        const weights = `--morphs=${expected.weights.join(',')}`;
        const character = await poseOf([skel, skin, ...morphs], ['--vertices', weights, ...posing(posed)]);
        expect(character.morphs.map((m) => m.weight)).toEqual(expected.weights);
        expectSkin(character, { ...expected, vertices });
        const bare = await poseOf([skin, ...morphs], ['--vertices', weights]);
        const listed = vertices.flatMap((v) => (bare.positions ?? []).slice(3 * v, 3 * v + 3));
        expectClose(listed, expected.blended_positions.flat(), WITHIN.reference, 'blended positions');
      }
    });
  }
});

describeShared('marrow channels, against the reference', () => {
  interface Channels {
    readonly files: readonly {
      readonly anim: string;
      readonly numchannels: number;
      readonly channels: readonly {
        readonly index: number;
        readonly times: readonly number[];
        readonly values: readonly number[];
        readonly alternatives: Readonly<Record<string, number>>;
      }[];
    }[];
  }
  for (const { anim, numchannels, channels } of conformance<Channels>('channels.json').files) {
    it(`marrow channels evaluates ${anim}`, async () => {
      for (const { index, times, values, alternatives } of channels) {
        const args = ['channels', anim, '--times', times.join(',')];
        const got = (await commandJson<ChannelsJson>(args, SHARED)).channels;
        expect(got).toHaveLength(numchannels);
        // At a jump either side is accepted.
        const expected = values.map((value, i) => {
          const other = alternatives[i];
          return other !== undefined && Math.abs(got[index][i] - other) < Math.abs(got[index][i] - value)
            ? other
            : value;
        });
        expectClose(got[index], expected, WITHIN.reference, `channel ${index}`);
      }
    });
  }
});

describeShared('marrow info, on files with something wrong', () => {
  interface Cases {
    readonly cases: readonly {
      readonly file: string;
      readonly with: readonly string[];
      readonly expect: string;
      readonly lines: readonly number[];
      readonly what: string;
    }[];
  }
  const folder = sharedPath('data/malformed');
  for (const { file, with: others, expect: expected, lines, what } of conformance<Cases>('diagnostics.json').cases) {
    it(`marrow info on ${file}: ${what}`, async () => {
      const args = ['info', file, ...others, '--json'];
      const { code, out, err } = await command(args, folder);
      const { files, diagnostics } = JSON.parse(out) as InfoJson;
      const own = diagnostics.filter((d) => d.file === file);
      const of = (...severities: string[]) => own.filter((d) => severities.includes(d.severity));

      expect(code).toBe(diagnostics.some((d) => d.severity === 'error') ? 1 : 0);
      for (const { code: name } of diagnostics) expect(err).toContain(name);
      const telling = {
        error: of('error'),
        warning: of('warning'),
        info: of('info'),
        diagnostic: of('error', 'warning'),
      }[expected];
      if (telling) {
        expect(telling).not.toEqual([]);
        if (lines.length) for (const { line } of telling) expect(lines).toContain(line);
      }
      if (expected === 'none') expect(of('error', 'warning')).toEqual([]);
      if (expected === 'warning' || expected === 'info') expect(of('error')).toEqual([]);
      if (expected === 'error') expect(files[0]).toEqual({ name: file, kind: expect.any(String), loaded: false });
      for (const { name } of files.slice(1)) {
        const mistaken = diagnostics.filter((d) => d.file === name && d.severity === 'error');
        expect(mistaken, `${name} is blamed for ${file}`).toEqual([]);
      }
    });
  }
});
