import { describe, expect, it } from 'vitest';
import { documentIn } from '../../../src/edit/change.ts';
import { setExtrapolation } from '../../../src/edit/commands/extrapolation.ts';
import { keyPose } from '../../../src/edit/commands/keying.ts';
import { addKey, insertKeys, removeKeys } from '../../../src/edit/commands/keys.ts';
import { pasteKeys } from '../../../src/edit/commands/paste.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { convertToKeys } from '../../../src/edit/commands/samples.ts';
import { copyKeys } from '../../../src/edit/keys/clipboard.ts';
import { rangeOfKeys } from '../../../src/edit/takes.ts';
import { shownTake } from '../../../src/model/document.ts';
import { keysOf } from '../../../src/model/takes/take.ts';
import { documentWith, swing } from './made.ts';

const c1 = { characterId: 'c1' };
/** The head's three angles have keys, all else follows the samples. */
const half = convertToKeys.run(documentWith(), {
  ...c1,
  channels: [9, 10, 11],
  tolerance: { position: 0.01, angle: 0.01 },
}).document;
const halfTake = shownTake(half.characters[0]) ?? swing;

describe('keys over samples', () => {
  it('keys over samples are refused, with the way out', () => {
    const document = documentWith();
    const way = 'Convert to keys first';
    expect(() => insertKeys.run(document, { ...c1, channels: [3, 4], timeSeconds: 1 })).toThrow(way);
    expect(() => addKey.run(document, { ...c1, channel: 3, timeSeconds: 1, value: 1 })).toThrow(way);
    expect(() => keyPose.run(document, { ...c1, timeSeconds: 1 })).toThrow(way);
    expect(() => setExtrapolation.run(document, { ...c1, channels: [3], side: 'in', extrapolation: 'cycle' })).toThrow(
      way,
    );
    const copied = copyKeys(halfTake, [{ channel: 9, indices: [0] }]);
    expect(() => pasteKeys.run(half, { ...c1, copied, into: [3], timeSeconds: 1, mode: 'merge' })).toThrow(way);
  });

  it('keys over samples are made on the channels beside them that have keys', () => {
    const keyed = keyPose.run(half, { ...c1, timeSeconds: 0.123 });
    expect(keyed.keys.map((k) => k.channel)).toEqual([9, 10, 11]);
    const inserted = insertKeys.run(half, { ...c1, channels: [3, 9], timeSeconds: 0.321 });
    expect(inserted.keys.map((k) => k.channel)).toEqual([9]);
    expect(shownTake(inserted.document.characters[0])?.samples).toBe(swing.samples);
  });

  it('keys over samples go back to the samples beneath when the last of them is deleted', () => {
    const indices = [...keysOf(halfTake.channels[9]).times.keys()];
    const { document } = removeKeys.run(half, { ...c1, keys: [{ channel: 9, indices }], timeSeconds: 1 });
    const take = shownTake(document.characters[0]) ?? halfTake;
    expect([take.channels[9].kind, take.channels[10].kind]).toEqual(['samples', 'keys']);
  });

  it('keys over samples are not made by posing: changes stay unkeyed, with auto-key too', () => {
    for (const key of [undefined, {}]) {
      const document = documentIn(
        setDofs.run(half, {
          ...c1,
          dofs: [
            { index: 3, value: 1 },
            { index: 9, value: 2 },
          ],
          timeSeconds: 1,
          key,
        }),
      );
      const [character] = document.characters;
      expect(character.unkeyed).toMatchObject(key ? { dofs: [3], values: [1] } : { dofs: [3, 9], values: [1, 2] });
      expect(shownTake(character)?.channels[3]).toBe(halfTake.channels[3]);
    }
  });

  it('count together with samples for what a take’s range is', () => {
    expect(rangeOfKeys(swing)).toEqual([0, 2]);
    expect(rangeOfKeys(halfTake)).toEqual([0, 2]);
  });
});
