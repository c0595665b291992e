/** Rows, curves and keys of two selected characters, of which one starts half a second into its take. */
import fc from 'fast-check';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { moveKeys, rippleKeys, scaleKeys } from '../../../../src/edit/commands/keys.ts';
import { type Document, shownTake } from '../../../../src/model/document.ts';
import { keysOf } from '../../../../src/model/takes/take.ts';
import { PlotScene } from '../../../../src/ui/editors/curves/plot-scene.ts';
import { keysDrag } from '../../../../src/ui/editors/curves/tools/move-keys.ts';
import { slopeDrag } from '../../../../src/ui/editors/curves/tools/slope.ts';
import type { PlotAccess } from '../../../../src/ui/editors/curves/tools/tool.ts';
import { channelName } from '../../../../src/ui/editors/timeline/channels.ts';
import {
  channelsInView,
  onAllInHand,
  selectedKeys,
  selectedKeysInView,
  selectKeys,
} from '../../../../src/ui/editors/timeline/current-take.ts';
import { rippleSeconds } from '../../../../src/ui/editors/timeline/edit-all.ts';
import { followCharacter } from '../../../../src/ui/editors/timeline/follow-character.ts';
import { selectedText, selectWhere } from '../../../../src/ui/editors/timeline/key-edits.ts';
import { isolateOfAll, listedOfAll, toggleIn, viewOfAll } from '../../../../src/ui/editors/timeline/listed-of-all.ts';
import { rowsOfAll } from '../../../../src/ui/editors/timeline/rows-of-all.ts';
import { timelineTake } from '../../../../src/ui/editors/timeline/timeline-take.ts';
import { runAction } from '../../../../src/ui/state/actions/action.ts';
import { NOTHING_PICKED } from '../../../../src/ui/state/timeline.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { capture } from '../../builders.ts';
import { OFFSET, withTwoCharacters } from '../../two-characters.ts';

let wb: Workbench;
const shown = () => {
  const take = timelineTake(wb);
  if (!take) throw new Error('Both have takes.');
  return take;
};
const timesOf = (document: Document, character: number, channel: number) => [
  ...keysOf(shownTake(document.characters[character])?.channels[channel]).times,
];
const now = (character: number, channel: number) => timesOf(wb.store.document, character, channel);
/** The walker's channels are after those of the active flyer. */
const WALKER = 9;

beforeEach(() => {
  wb = withTwoCharacters();
  followCharacter(wb);
  wb.timeline.change({ tab: 'dope' });
});

afterEach(() => void vi.unstubAllGlobals());

describe('the takes of several characters as one', () => {
  it('channels of the active one keep their numbers, and keys of the other are where the transport has them', () => {
    const { take, character, parts } = shown();
    expect(character.name).toBe('Flyer');
    expect(parts.map(({ character: { name }, first }) => [name, first])).toEqual([
      ['Walker', WALKER],
      ['Flyer', 0],
    ]);
    expect([...keysOf(take.channels[1]).times]).toEqual([0.5, 1.5]);
    expect([...keysOf(take.channels[WALKER]).times]).toEqual([0, 1, 2].map((time) => time + OFFSET));
    expect(timelineTake(wb)).toBe(shown());
  });

  it('of one character it is its own take', () => {
    wb.store.select({ characterId: 'walker', joint: 1 });
    expect(shown().take).toBe(shownTake(wb.store.document.characters[0]));
  });

  it('samples of the other are listed with their range, and its keys are shown beside', () => {
    const sampled = capture(9, 0.1, 11);
    wb = withTwoCharacters({ takes: [sampled], timeOffsetSeconds: OFFSET });
    wb.store.select({ characterId: 'walker', joint: 1, beside: [{ characterId: 'flyer', joint: 1 }] });
    const rows = rowsOfAll(shown(), wb.timeline.view.get()).filter(({ characterId }) => characterId === 'flyer');
    expect(rows[0].sampled).toEqual([-OFFSET, 1 - OFFSET]);
    expect(
      shown()
        .take.channels.slice(WALKER)
        .every(({ kind }) => kind === 'rest'),
    ).toBe(true);
  });

  it('the sheet has a summary, then each character with its rows, which are expanded on their own', () => {
    const rows = () => rowsOfAll(shown(), wb.timeline.view.get()).map(({ label, kind }) => label || kind);
    expect(rows().slice(0, 5)).toEqual(['summary', 'Walker', 'Root translation', 'hips', 'leg']);
    expect(rows().slice(5)).toEqual(['Flyer', 'Root translation', 'body', 'wing']);
    runAction(wb, 'dope.unfoldAll');
    expect(rows()).toContain('rx');
    const { others, unfolded } = wb.timeline.view.get();
    expect([unfolded, others.walker.unfolded]).toEqual([
      [-1, 0, 1],
      [-1, 0, 1],
    ]);
    runAction(wb, 'dope.foldAll');
    expect(rows()).toHaveLength(9);
  });
});

describe('keys of several characters', () => {
  const BOTH = [
    { channel: 6, indices: [0] },
    { channel: WALKER + 6, indices: [0] },
  ];
  const STEPS: readonly (readonly [id: string, walker: readonly number[], flyer: readonly number[]])[] = [
    ['timeline.later', [0.1, 1], [0.6, 1]],
    ['timeline.delete', [1], [1]],
    ['dope.rippleLater', [0.1, 1.1], [0.6, 1.1]],
    ['timeline.cut', [1], [1]],
  ];

  it.each(STEPS)(
    '%s changes those of both in one step, and undo brings back keys and selection',
    (id, walker, flyer) => {
      selectKeys(wb, BOTH);
      const { document, selection } = wb.store;
      expect(selection).toMatchObject({
        characterId: 'flyer',
        keys: [{ channel: 6, indices: [0] }],
        beside: [{ characterId: 'walker', keys: [{ channel: 6, indices: [0] }] }],
      });
      runAction(wb, id);
      expect(now(0, 6).map((time) => Number(time.toFixed(9)))).toEqual(walker);
      expect(now(1, 6).map((time) => Number(time.toFixed(9)))).toEqual(flyer);
      expect(wb.store.undoLabel).toMatch(/^\w+ keys of 2 characters$/);
      wb.store.undo();
      expect(wb.store.document).toEqual(document);
      expect(wb.store.selection).toEqual(selection);
      expect(wb.store.undoLabel).toBeUndefined();
    },
  );

  it.each(['timeline.up', 'timeline.tangents.linear', 'timeline.unify', 'timeline.extrapolation.both.cycle'])(
    '%s is for those of both',
    (id) => {
      selectKeys(wb, BOTH);
      const before = wb.store.document;
      runAction(wb, id);
      const channel = (document: Document, c: number) => shownTake(document.characters[c])?.channels[6];
      const isChanged = [0, 1].map((c) => channel(wb.store.document, c) !== channel(before, c));
      expect(isChanged).toEqual(id === 'timeline.unify' ? [false, false] : [true, true]);
      wb.store.undo();
      expect(wb.store.document).toEqual(before);
    },
  );

  it('they move by the same time, whatever is selected', () => {
    const { characters } = wb.store.document;
    const one = fc.record({ channel: fc.nat(2 * WALKER - 1), seconds: fc.double({ min: -3, max: 3, noNaN: true }) });
    fc.assert(
      fc.property(fc.array(one, { minLength: 1 }), fc.integer({ min: -30, max: 30 }), (picked, frames) => {
        const channels = [...new Set(picked.map(({ channel }) => channel))];
        wb.store.replace('Again', { ...wb.store.document, characters });
        selectWhere(wb, channels, () => true);
        const before = shown().take;
        const { document } = wb.store;
        const keys = selectedKeys(wb);
        wb.store.apply(onAllInHand(wb, moveKeys), { characterId: shown().character.id, keys, seconds: frames / 8 });
        for (const [channel, { times }] of shown()
          .take.channels.map((c) => keysOf(c))
          .entries()) {
          const by = channels.includes(channel) ? frames / 8 : 0;
          expect([...times]).toEqual([...keysOf(before.channels[channel]).times].map((time) => time + by));
        }
        if (wb.store.document !== document) wb.store.undo();
        expect(wb.store.document).toEqual(document);
      }),
    );
  });

  it('those of the one with a take are edited where the active one has none, and stay selected', () => {
    wb = withTwoCharacters({ takes: [] });
    followCharacter(wb);
    wb.timeline.change({ tab: 'dope' });
    const keys = [{ channel: 6, indices: [0] }];
    selectKeys(wb, keys);
    runAction(wb, 'timeline.later');
    runAction(wb, 'timeline.later');
    expect(now(0, 6)).toEqual([0.2, 1]);
    expect(wb.store.selection).toEqual({
      ...{ characterId: 'flyer', joint: 1 },
      beside: [{ characterId: 'walker', joint: 1, keys }],
    });
    runAction(wb, 'dope.unfoldAll');
    expect(wb.timeline.view.get().others.walker.unfolded).toEqual([-1, 0, 1]);
  });

  it('they ripple by the same time, as far back as all of them can', () => {
    selectKeys(wb, [
      { channel: 6, indices: [1] },
      { channel: WALKER + 6, indices: [1] },
    ]);
    const seconds = rippleSeconds(shown(), selectedKeys(wb), -0.8);
    wb.store.apply(onAllInHand(wb, rippleKeys), { characterId: 'flyer', keys: selectedKeys(wb), seconds });
    expect([now(0, 6)[1], now(1, 6)[1]]).toEqual([0.5, 0.5]);
  });

  it('they are scaled about one time of the transport', () => {
    selectKeys(wb, [
      { channel: 1, indices: [0, 1] },
      { channel: WALKER + 1, indices: [0, 1] },
    ]);
    const about = { pivotSeconds: OFFSET + 1, timeFactor: 2, valueFactor: 1 };
    wb.store.apply(onAllInHand(wb, scaleKeys), { characterId: 'flyer', keys: selectedKeys(wb), ...about });
    expect(now(0, 1)).toEqual([-1, 3]);
    expect(now(1, 1)).toEqual([-0.5, 1.5]);
  });

  it('copied together they are pasted together, each where its character is', () => {
    selectKeys(wb, BOTH);
    runAction(wb, 'timeline.copy');
    wb.transport.update((p) => ({ ...p, timeSeconds: 1.5 }));
    runAction(wb, 'timeline.paste');
    expect(now(0, 6)).toEqual([0, 1, 1.5]);
    expect(now(1, 6)).toEqual([0.5, 1, 1.5 + OFFSET]);
    expect(wb.store.undoLabel).toBe('Paste keys on 2 characters');
    wb.store.undo();
    wb.store.select({ characterId: 'flyer', joint: 1 });
    runAction(wb, 'timeline.paste');
    expect([now(0, 6), now(1, 6)]).toEqual([
      [0, 1],
      [0.5, 1, 1.5 + OFFSET],
    ]);
  });

  it('copied together they are pasted into all listed channels of each', () => {
    wb.timeline.change({
      tab: 'curves',
      list: 'pinned',
      pinned: [1],
      others: { walker: { ...NOTHING_PICKED, pinned: [0] } },
    });
    selectKeys(wb, [
      { channel: 1, indices: [0] },
      { channel: WALKER, indices: [2] },
    ]);
    runAction(wb, 'timeline.copy');
    wb.timeline.change({ pinned: [0], others: { walker: { ...NOTHING_PICKED, pinned: [1, 2] } } });
    wb.transport.update((p) => ({ ...p, timeSeconds: 0 }));
    const before = wb.store.document;
    runAction(wb, 'timeline.pasteInto');
    // The walker's was 2 s before the flyer's at 0.5 s of its take: at 0 s.
    expect([now(0, 1), now(0, 2), now(1, 0)]).toEqual([
      [0, 2],
      [0, 1, 2],
      [0, 0.5, 1, 2],
    ]);
    wb.store.undo();
    expect(wb.store.document).toEqual(before);
    // Those of one go into the channels of all.
    selectKeys(wb, [{ channel: 0, indices: [0] }]);
    runAction(wb, 'timeline.copy');
    wb.transport.update((p) => ({ ...p, timeSeconds: 1.25 }));
    runAction(wb, 'timeline.pasteInto');
    expect([now(0, 1), now(0, 2), now(1, 0)]).toEqual([
      [0, 1.25, 2],
      [0, 1, 1.25],
      [0, 1, 1.75, 2],
    ]);
    expect(wb.store.undoLabel).toBe('Paste keys on 2 characters');
  });

  it('those of one are pasted on the one with a take where the active one has none', () => {
    wb = withTwoCharacters({ takes: [] });
    followCharacter(wb);
    wb.timeline.change({ tab: 'dope' });
    selectKeys(wb, [{ channel: 6, indices: [0] }]);
    runAction(wb, 'timeline.copy');
    wb.transport.update((p) => ({ ...p, timeSeconds: 0.5 }));
    runAction(wb, 'timeline.paste');
    expect(now(0, 6)).toEqual([0, 0.5, 1]);
  });

  it('they are inserted in both at the current time', () => {
    wb.transport.update((p) => ({ ...p, timeSeconds: 0.25 }));
    runAction(wb, 'timeline.insertKey');
    expect(now(0, 6)).toEqual([0, 0.25, 1]);
    expect(now(1, 6)).toEqual([0.5, 0.25 + OFFSET, 1]);
    expect(wb.store.undoLabel).toBe('Insert keys of 2 characters');
  });

  it.each(['flyer', 'walker'])('they are inserted beside a capture, which takes none; active: %s', (active) => {
    wb = withTwoCharacters({ takes: [capture(9, 0.1, 11)] });
    const [beside] = ['flyer', 'walker'].filter((id) => id !== active);
    wb.store.select({ characterId: active, joint: 1, beside: [{ characterId: beside, joint: 1 }] });
    wb.timeline.change({ tab: 'dope' });
    const [, captured] = wb.store.document.characters;
    wb.transport.update((p) => ({ ...p, timeSeconds: 0.25 }));
    runAction(wb, 'timeline.insertKey');
    runAction(wb, 'timeline.extrapolation.both.cycle');
    expect(now(0, 6)).toEqual([0, 0.25, 1]);
    expect(shownTake(wb.store.document.characters[0])?.channels[6].extrapolateIn).toBe('cycle');
    expect(wb.store.document.characters[1]).toBe(captured);
    wb.store.select({ characterId: 'flyer', joint: 1 });
    expect(() => runAction(wb, 'timeline.insertKey')).toThrow('are sampled');
  });

  it('they are counted together', () => {
    selectKeys(wb, BOTH);
    expect(selectedText(wb)).toBe('2 keys of 2 channels, at 0 s');
    selectKeys(wb, BOTH.slice(1));
    expect(selectedText(wb)).toBe('1 key of Walker leg rx, at 0 s');
  });
});

describe('curves of several characters', () => {
  beforeEach(() => wb.timeline.change({ tab: 'curves' }));
  const scene = () => {
    const plot = new PlotScene(wb);
    return plot.scene;
  };

  it('those of the selected joints of each are listed and drawn, named with it, in colours of their own', () => {
    expect(listedOfAll(wb).map(channelName)).toEqual([
      ...['rx', 'ry', 'rz'].map((dof) => `Walker leg ${dof}`),
      ...['rx', 'ry', 'rz'].map((dof) => `Flyer wing ${dof}`),
    ]);
    const { lines } = scene();
    expect(lines.map(({ name, channel }) => [name, channel])).toEqual([
      ['Walker leg rx', WALKER + 6],
      ['Flyer wing rx', 6],
    ]);
    expect(lines[0].colour).not.toEqual(lines[1].colour);
  });

  it('any of them is hidden, pinned and isolated, as its character knows it', () => {
    toggleIn(wb, 'hidden', WALKER + 6);
    expect(scene().lines.map(({ channel }) => channel)).toEqual([6]);
    expect(wb.timeline.view.get().others.walker.hidden).toEqual([6]);
    toggleIn(wb, 'hidden', WALKER + 6);
    isolateOfAll(wb, [WALKER + 6]);
    expect(viewOfAll(wb).isolated).toEqual([WALKER + 6]);
    expect(channelsInView(wb)).toEqual([WALKER + 6]);
    selectKeys(wb, [
      { channel: 6, indices: [0] },
      { channel: WALKER + 6, indices: [0] },
    ]);
    expect(selectedKeysInView(wb)).toEqual([{ channel: WALKER + 6, indices: [0] }]);
    runAction(wb, 'timeline.later');
    expect([now(0, 6), now(1, 6)]).toEqual([
      [0.1, 1],
      [0.5, 1],
    ]);
    expect(selectedKeys(wb)).toHaveLength(2);
    isolateOfAll(wb, undefined);
    expect(scene().lines).toHaveLength(2);
  });

  const pointer = (x: number, y: number) => ({ x, y, shift: false, ctrl: false, alt: false });
  const plotted = (): PlotAccess => {
    const plot = new PlotScene(wb);
    plot.width = 200;
    plot.height = 200;
    wb.store.subscribe(() => plot.invalidate());
    return { wb, scene: () => plot.scene, look: () => {}, showBox: () => {}, say: () => {} };
  };

  it('a dragged key of one takes the selected ones of the other with it, as one step', () => {
    vi.stubGlobal('window', { addEventListener: () => {}, removeEventListener: () => {} });
    wb.timeline.change({ window: { from: 0, to: 2 }, snapsToFrames: false });
    selectKeys(wb, [
      { channel: 6, indices: [1] },
      { channel: WALKER + 6, indices: [1] },
    ]);
    const before = wb.store.document;
    // 100 pixels per second; the walker's second key is 1 s after the start.
    const drag = keysDrag(plotted(), { kind: 'key', channel: WALKER + 6, index: 1 }, pointer(100, 100));
    drag.move(pointer(125, 100));
    drag.end(pointer(125, 100), true);
    expect([now(0, 6), now(1, 6)]).toEqual([
      [0, 1.25],
      [0.5, 1.25],
    ]);
    expect(wb.store.undoLabel).toBe('Move keys of 2 characters');
    wb.store.undo();
    expect(wb.store.document).toEqual(before);
  });

  it('a handle of either sets its slope, and all keys stay selected', () => {
    vi.stubGlobal('window', { addEventListener: () => {}, removeEventListener: () => {} });
    const keys = [
      { channel: 6, indices: [1] },
      { channel: WALKER + 6, indices: [0] },
    ];
    selectKeys(wb, keys);
    const before = wb.store.document.characters;
    const drag = slopeDrag(plotted(), { kind: 'handle', channel: WALKER + 6, index: 0, side: 'out' });
    drag.move(pointer(150, 20));
    drag.end(pointer(150, 20), true);
    expect(wb.store.document.characters.map((one, i) => one !== before[i])).toEqual([true, false]);
    expect(selectedKeys(wb)).toEqual(keys);
  });

  it('a tool for one character is for the active one', async () => {
    await runAction(wb, 'timeline.loop');
    const extrapolates = (c: number) => shownTake(wb.store.document.characters[c])?.channels[6].extrapolateOut;
    expect([extrapolates(0), extrapolates(1)]).toEqual(['constant', 'cycle']);
  });
});
