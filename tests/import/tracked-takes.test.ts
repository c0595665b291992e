import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { importFile } from '../../src/files/imports.ts';
import type { WholeCharacter } from '../../src/model/files.ts';
import { type TrackedRotation, trackedOf } from '../../src/model/takes/tracked-take.ts';
import { describeShared, sharedBytes } from '../helpers/shared.ts';
import { chainGlb } from './chain-glb.ts';

async function characterOf(bytes: Uint8Array<ArrayBuffer>): Promise<WholeCharacter> {
  const { value, diagnostics } = await importFile('gltf', {
    fileName: 'a.glb',
    bytes,
    beside: async () => undefined,
  });
  if (!value) throw new Error(JSON.stringify(diagnostics));
  return value.characters[0];
}

const chain = () => characterOf(chainGlb({ joints: 4, takes: 5, keys: 12, vertices: 8 }));
const isTracked = ({ takes }: WholeCharacter) => takes.map((take) => trackedOf(take) !== undefined);

function rotationsOf({ takes }: WholeCharacter): readonly TrackedRotation[] {
  const all = takes.flatMap((take) => trackedOf(take)?.tracked ?? []);
  return [...new Set(all.flatMap((channel) => (channel.kind === 'tracked' ? channel.rotation : [])))];
}

describe('takes with tracks of quaternions', () => {
  it('are read without fitting any rotation, each made when it is first asked for its channels', async () => {
    const character = await chain();
    expect(isTracked(character)).toEqual([true, true, true, true, true]);
    const { channels } = character.takes[2];
    expect(isTracked(character)).toEqual([true, true, false, true, true]);
    // Once.
    expect(character.takes[2].channels).toBe(channels);
  });

  it('are the same in whatever order they are made', async () => {
    const expected = (await chain()).takes.map(({ channels }) => channels);
    await fc.assert(
      fc.asyncProperty(fc.shuffledSubarray([0, 1, 2, 3, 4], { minLength: 1 }), async (order) => {
        const { takes } = await chain();
        for (const take of order) expect(takes[take].channels).toStrictEqual(expected[take]);
      }),
      { numRuns: 10 },
    );
  });

  it('hold the numbers of the file, not copies of them', async () => {
    const bytes = chainGlb({ joints: 4, takes: 5, keys: 12, vertices: 8 });
    const rotations = rotationsOf(await characterOf(bytes));
    expect(rotations).toHaveLength(20);
    expect(rotations.every(({ track }) => track.values.buffer === bytes.buffer)).toBe(true);
    // Their times are one list.
    expect(new Set(rotations.map(({ track }) => track.times)).size).toBe(1);
  });

  it('have ordinary copies, whoever makes them', async () => {
    const [take, other] = (await chain()).takes;
    const cloned = structuredClone(take);
    expect(trackedOf(cloned)).toBeUndefined();
    expect(cloned.channels).toStrictEqual(take.channels);
    const changed = { ...other, name: 'other' };
    expect(trackedOf(changed)).toBeUndefined();
    expect(changed.channels).toBe(other.channels);
  });
});

describeShared('real files with tracks of quaternions', () => {
  it.each(['Fox', 'bird-animations', 'greenman'])('%s is read without fitting any rotation', async (file) => {
    const bytes = new Uint8Array(sharedBytes(`data/gltf/${file}.glb`));
    const character = await characterOf(bytes);
    const rotations = rotationsOf(character);
    expect(rotations.length).toBeGreaterThan(0);
    expect(rotations.every(({ track }) => track.values.buffer === bytes.buffer)).toBe(true);
    for (const take of character.takes) {
      const tracked = trackedOf(take)?.tracked ?? take.channels;
      expect(take.channels).toHaveLength(tracked.length);
      // What is no rotation is passed on as it is.
      tracked.forEach((channel, i) => {
        if (channel.kind !== 'tracked') expect(take.channels[i]).toBe(channel);
      });
    }
  });
});
