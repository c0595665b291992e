import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import {
  activateLayer,
  addLayer,
  flattenLayers,
  mergeLayerDown,
  setLayer,
} from '../../../src/edit/commands/beside/layers.ts';
import { keyPose } from '../../../src/edit/commands/keying.ts';
import { keyForMoment } from '../../../src/edit/commands/moment.ts';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { mirrorTakes, setTakeSpeed } from '../../../src/edit/commands/take-edits.ts';
import { abruptKey, keyedPose } from '../../../src/edit/keys/keyed-pose.ts';
import { Store } from '../../../src/edit/store.ts';
import { poseAt } from '../../../src/evaluate/pose.ts';
import { steppedCharacter } from '../../../src/evaluate/stepped-take.ts';
import { type Document, shownTake } from '../../../src/model/document.ts';
import { baseOf } from '../../../src/model/takes/take.ts';
import { character, documentOf, skeleton, takeOfValues } from '../../helpers/builders.ts';
import { between } from '../keys/channels.ts';

const DOFS = 9;
const HERO = documentOf(
  character({
    skeleton: skeleton(2),
    takes: [takeOfValues('walk', [1, 2, 3, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6])],
    shownTake: 0,
    clampsToLimits: false,
  }),
);
const WHO = { characterId: 'c1' };

function shownIn({ characters: [one] }: Document, timeSeconds: number): number[] {
  const out = new Float64Array(DOFS);
  poseAt(one, timeSeconds, out);
  return [...out];
}

/** With a layer above the take, which is active. */
function layered(more: { readonly mode?: 'additive' | 'override'; readonly weight?: number } = {}): Store {
  const store = new Store(HERO);
  store.apply(addLayer, { ...WHO, ...(more.mode && { mode: more.mode }) });
  if (more.weight !== undefined) store.apply(setLayer, { ...WHO, layer: 0, weight: more.weight });
  return store;
}

describe('keying into a layer', () => {
  it('keeps what the stepped preview shows, as unkeyed and as keyed', () => {
    const store = layered();
    store.apply(activateLayer, { ...WHO, layer: -1 });
    for (const [timeSeconds, value] of [
      [0, 0],
      [1, 1],
    ])
      store.apply(setDofs, { ...WHO, dofs: [{ index: 0, value }], timeSeconds, key: {} });
    store.apply(activateLayer, { ...WHO, layer: 0 });
    const NOW = { ...WHO, timeSeconds: 0.75 };
    const seen = () => shownIn(documentOf(steppedCharacter(store.document.characters[0])), 0.75)[0];
    expect(seen()).toBe(0);
    store.apply(keyPose, { ...NOW, dofs: [0], stepped: true });
    expect(seen()).toBe(0);
    store.apply(setDofs, { ...NOW, dofs: [{ index: 0, value: 4 }], key: { stepped: true } });
    expect(seen()).toBe(4);
  });

  it('shows what was wanted, and leaves the base as it was', () => {
    const mode = fc.constantFrom('additive' as const, 'override' as const);
    fc.assert(
      fc.property(mode, between(0.1, 1), between(-3, 3), fc.nat(DOFS - 1), (how, weight, wanted, dof) => {
        const store = layered({ mode: how, weight });
        const before = shownIn(store.document, 0.5);
        store.apply(setDofs, { ...WHO, dofs: [{ index: dof, value: wanted }], timeSeconds: 0.5 });
        expect(shownIn(store.document, 0.5)[dof]).toBe(wanted);
        expect(shownIn(store.document, 0.6)).toEqual(before);
        store.apply(keyPose, { ...WHO, dofs: [dof], timeSeconds: 0.5 });
        shownIn(store.document, 0.5).forEach((value, i) => {
          expect(value).toBeCloseTo(i === dof ? wanted : before[i], 9);
        });
        const take = shownTake(store.document.characters[0]);
        expect(take && baseOf(take).channels).toBe(HERO.characters[0].takes[0].channels);
      }),
    );
  });

  it('is refused, with the layer named, where the layer has no part in what is shown', () => {
    const store = layered();
    store.apply(setLayer, { ...WHO, layer: 0, mute: true });
    const { document } = store;
    const key = () => store.apply(keyPose, { ...WHO, dofs: [4], timeSeconds: 0 });
    expect(key).toThrow('The layer "layer" is muted: keys there would not show.');
    expect(store.document).toBe(document);
    store.apply(setLayer, { ...WHO, layer: 0, mute: false, joints: [0] });
    store.apply(keyPose, { ...WHO, dofs: [4], timeSeconds: 0 });
    expect(() => store.apply(keyPose, { ...WHO, dofs: [7], timeSeconds: 0 })).toThrow('Layer "layer" has no part');
    // The whole pose is what the layer touches.
    store.apply(keyPose, { ...WHO, timeSeconds: 0 });
    const keyed = shownTake(store.document.characters[0])?.channels.map(({ kind }) => kind === 'keys');
    expect(keyed).toEqual([false, false, false, true, true, true, false, false, false]);
  });

  it('goes into the layer that was made active, which is no step, and undo returns to the byte', () => {
    const store = layered();
    const added = store.document;
    store.apply(setDofs, { ...WHO, dofs: [{ index: 4, value: 1 }], timeSeconds: 0, key: {} });
    const keyed = store.document;
    store.apply(activateLayer, { ...WHO, layer: -1 });
    expect(store.undoLabel).toMatch(/^Key/);
    expect(shownIn(store.document, 0)).toEqual(shownIn(keyed, 0));
    store.apply(activateLayer, { ...WHO, layer: 0 });
    expect(shownTake(store.document.characters[0])).toEqual(shownTake(keyed.characters[0]));
    store.undo();
    expect(store.document).toEqual(added);
    store.undo();
    expect(store.document.characters[0].takes).toEqual(HERO.characters[0].takes);
  });

  it('for a moment adds what was posed around that time alone, and is refused for a layer that overrides', () => {
    const store = layered({ weight: 0.5 });
    const before = [0.1, 1.5].map((time) => shownIn(store.document, time));
    const { document } = store;
    store.apply(setDofs, { ...WHO, dofs: [{ index: 4, value: 1 }], timeSeconds: 0.5, key: {} });
    const pose = keyedPose(document, store.document, 0.5);
    expect(pose).toEqual({ characterId: 'c1', dofs: [{ index: 4, value: expect.closeTo(1, 12) }] });
    const [hero] = store.document.characters;
    expect(abruptKey(hero, pose?.dofs ?? [], 0.5)).toEqual({ kind: 'holds', dof: 4 });
    store.undo();
    const easing = { timeSeconds: 0.5, easeIn: 0.3, easeOut: 0.5 };
    store.apply(keyForMoment, { ...WHO, ...easing, dofs: pose?.dofs ?? [] });
    expect([0.1, 1.5].map((time) => shownIn(store.document, time))).toEqual(before);
    expect(shownIn(store.document, 0.5)[4]).toBeCloseTo(1, 12);
    const over = layered({ mode: 'override' });
    expect(() => over.apply(keyForMoment, { ...WHO, ...easing, dofs: [{ index: 4, value: 1 }] })).toThrow(
      'Layer "layer" overrides the motion below it',
    );
  });

  it('is kept for one that edits whole takes: that is refused, and says what to do first', () => {
    const { document } = layered();
    const [hero] = document.characters;
    const takes = [{ characterId: 'c1', take: 0 }];
    const flattenFirst = 'walk has layers, and this changes takes as a whole. Flatten them first';
    expect(() => setTakeSpeed.run(document, { takes, factor: 2 })).toThrow(flattenFirst);
    expect(() => mirrorTakes.run(document, { takes })).toThrow(flattenFirst);
    const keyed = documentOf({ ...hero, takes: HERO.characters[0].takes });
    expect(setTakeSpeed.run(keyed, { takes, factor: 2 })).not.toBe(keyed);
  });

  it('moves the same once layers are merged and flattened', () => {
    const store = layered({ weight: 0.5 });
    store.apply(setDofs, { ...WHO, dofs: [{ index: 4, value: 1 }], timeSeconds: 0, key: {} });
    store.apply(addLayer, WHO);
    store.apply(setDofs, { ...WHO, dofs: [{ index: 4, value: 2 }], timeSeconds: 1, key: {} });
    const shown = [0, 0.3, 1].map((time) => shownIn(store.document, time));
    const same = () => {
      const now = [0, 0.3, 1].flatMap((time) => shownIn(store.document, time));
      now.forEach((value, i) => {
        expect(value).toBeCloseTo(shown.flat()[i], 12);
      });
    };
    store.apply(mergeLayerDown, { ...WHO, layer: 1 });
    same();
    expect(shownTake(store.document.characters[0])?.layers?.list.length).toBe(1);
    store.apply(flattenLayers, WHO);
    same();
    expect(shownTake(store.document.characters[0])?.layers).toBeUndefined();
  });
});
