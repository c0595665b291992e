import { describe, expect, it, vi } from 'vitest';
import { showTake } from '../../../../src/edit/commands/characters.ts';
import { setDofs } from '../../../../src/edit/commands/pose.ts';
import { poseAt } from '../../../../src/evaluate/pose.ts';
import { openFiles } from '../../../../src/files/open/open-files.ts';
import type { Character } from '../../../../src/model/document.ts';
import { keysOf, restChannel } from '../../../../src/model/takes/take.ts';
import { dofState, toggleKey } from '../../../../src/ui/editors/inspector/dof-mark.ts';
import { offerOverSamples } from '../../../../src/ui/editors/posing/auto-key-samples.ts';
import { KEYING_ACTIONS } from '../../../../src/ui/editors/posing/keying-actions.ts';
import { followOpened } from '../../../../src/ui/editors/posing/opened.ts';
import { autoKey, jointDofs } from '../../../../src/ui/editors/posing/pose-edits.ts';
import { isEnabled, runAction } from '../../../../src/ui/state/actions/action.ts';
import type { Workbench } from '../../../../src/ui/state/workbench.ts';
import { capture, channel, character, documentOf, skeleton, take, workbench } from '../../builders.ts';

const bones = skeleton(['hips', -1], ['leg', 0]);
const bare = character({ skeleton: bones, shownTake: -1 });
const wasp = (wb: Workbench): Character => wb.store.document.characters[0];
const keyCounts = (wb: Workbench) => wasp(wb).takes[wasp(wb).shownTake]?.channels.map((c) => keysOf(c).times.length);
const at = (wb: Workbench, timeSeconds: number) => wb.transport.update((p) => ({ ...p, timeSeconds }));
const enabled = (wb: Workbench) => KEYING_ACTIONS.filter((a) => isEnabled(wb, a)).map((a) => a.id);

describe('keying from the menu', () => {
  it('keys the whole pose of a character without a take, over the playback range', () => {
    const { wb } = workbench(documentOf(bare), { range: [0, 4], timeSeconds: 1 });
    runAction(wb, 'key.pose');
    expect(keyCounts(wb)).toEqual(new Array(9).fill(1));
    expect(wasp(wb).takes[0]).toMatchObject({ name: 'test_anim', range: [0, 4] });
    expect(wb.store.undoLabel).toBe('Key pose of wasp');
    wb.store.undo();
    expect(wasp(wb)).toBe(bare);
  });

  it('keys the selected joint, the root with its translation', () => {
    const { wb } = workbench(documentOf(bare));
    wb.store.select({ characterId: 'c1', joint: 1 });
    runAction(wb, 'key.joint');
    expect(keyCounts(wb)).toEqual([0, 0, 0, 0, 0, 0, 1, 1, 1]);
    wb.store.select({ characterId: 'c1', joint: 0 });
    runAction(wb, 'key.joint');
    expect(keyCounts(wb)).toEqual(new Array(9).fill(1));
    expect(jointDofs(bare, 0)).toEqual([0, 1, 2, 3, 4, 5]);
    expect(jointDofs(bare, 7)).toEqual([]);
  });

  it('reports that no joint is selected', () => {
    const { wb } = workbench(documentOf(bare));
    runAction(wb, 'key.joint');
    expect(wb.messages.passing.get()).toBe('Select a joint first.');
    expect(wasp(wb)).toBe(bare);
  });

  it('deletes the keys at the current time only', () => {
    const { wb } = workbench(documentOf(bare));
    for (const time of [0, 1]) {
      at(wb, time);
      runAction(wb, 'key.pose');
    }
    wb.store.select({ characterId: 'c1', joint: 1 });
    runAction(wb, 'key.deleteJointHere');
    expect(keyCounts(wb)).toEqual([2, 2, 2, 2, 2, 2, 1, 1, 1]);
    runAction(wb, 'key.deleteHere');
    expect(keyCounts(wb)).toEqual(new Array(9).fill(1));
    expect(keysOf(wasp(wb).takes[0].channels[0]).times).toEqual(Float64Array.of(0));
    expect(enabled(wb)).not.toContain('key.deleteHere');
  });

  it('keying from the menu makes keys with the chosen tangents', () => {
    const { wb } = workbench(documentOf(bare));
    runAction(wb, 'key.tangents.linear');
    runAction(wb, 'key.pose');
    expect(keysOf(wasp(wb).takes[0].channels[4]).tangentsIn.kinds).toEqual(Uint8Array.of(1));
    expect(autoKey(wb)).toBeUndefined();
    runAction(wb, 'key.auto');
    expect(autoKey(wb)).toEqual({ tangents: 'linear', playedRange: [0, 2] });
  });

  it('stops playback before keying, on a frame if keys snap to frames', () => {
    const timesAfter = (snapsToFrames: boolean) => {
      const { wb } = workbench(documentOf(bare), { playing: true, timeSeconds: 51.4 / 30 });
      wb.timeline.change({ snapsToFrames });
      runAction(wb, 'key.pose');
      expect(wb.transport.get().playing).toBe(false);
      const [time] = keysOf(wasp(wb).takes[0].channels[4]).times;
      expect(time).toBe(wb.transport.get().timeSeconds);
      return time * 30;
    };
    expect(timesAfter(true)).toBeCloseTo(51, 12);
    expect(timesAfter(false)).toBeCloseTo(51.4, 12);
  });

  it('keys at the playhead, on a frame or not', () => {
    const { wb } = workbench(documentOf(bare), { timeSeconds: 51.4 / 30 });
    runAction(wb, 'key.pose');
    expect(keysOf(wasp(wb).takes[0].channels[4]).times).toEqual(Float64Array.of(51.4 / 30));
  });

  it('keys a reset too while auto-key is on', () => {
    const { wb } = workbench(documentOf({ ...bare, pose: [1, 0, 0, 0, 0, 0, 0, 0, 0] }));
    runAction(wb, 'key.auto');
    runAction(wb, 'pose.resetToZero');
    expect(keyCounts(wb)).toEqual(new Array(9).fill(1));
  });

  it('discards unkeyed changes, and undo restores them', () => {
    const driven = take([0, 1], channel(0, 1));
    const { wb } = workbench(documentOf({ ...bare, takes: [driven], shownTake: 0 }));
    expect(enabled(wb)).not.toContain('key.dropUnkeyed');
    expect(enabled(wb)).not.toContain('key.forMoment');
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 0, value: 3 }], timeSeconds: 0 });
    runAction(wb, 'key.dropUnkeyed');
    expect(wasp(wb).unkeyed).toBeUndefined();
    wb.store.undo();
    expect(wasp(wb).unkeyed?.values).toEqual([3]);
  });

  it('keys the changed values, and leaves all other channels alone', () => {
    const [swing, still] = [channel(0, 1), channel(0, 1)];
    const { wb } = workbench(documentOf({ ...bare, takes: [take([0, 1], swing, still)], shownTake: 0 }), {
      timeSeconds: 0.5,
    });
    wb.store.select({ characterId: 'c1', joint: 1 });
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 0, value: 3 }], timeSeconds: 0.5 });
    runAction(wb, 'key.changed');
    const [keyed, other] = wasp(wb).takes[0].channels;
    expect([...keysOf(keyed).times]).toEqual([0, 0.5, 1]);
    expect(keysOf(keyed).values[1]).toBe(3);
    expect(other).toBe(still);
    expect(wasp(wb).unkeyed).toBeUndefined();
    expect(wb.store.undoLabel).toBe('Key tx of hips');
  });

  it('keys what was posed since a bare character was opened, whichever joint is selected, and again after undo', () => {
    const { wb } = workbench(documentOf(bare));
    followOpened(wb);
    wb.store.select({ characterId: 'c1', joint: 0 });
    const pose = () =>
      wb.store.apply(setDofs, {
        characterId: 'c1',
        dofs: [6, 8].map((index) => ({ index, value: 0.5 })),
        timeSeconds: 0,
      });
    pose();
    runAction(wb, 'key.changed');
    expect(keyCounts(wb)).toEqual([0, 0, 0, 0, 0, 0, 1, 0, 1]);
    wb.store.undo();
    runAction(wb, 'key.changed');
    expect(keyCounts(wb)).toEqual([0, 0, 0, 0, 0, 0, 1, 0, 1]);
    // What has keys and was not touched stays as it is: the selected joint is what is left.
    at(wb, 1);
    runAction(wb, 'key.changed');
    expect(keyCounts(wb)).toEqual([1, 1, 1, 1, 1, 1, 1, 0, 1]);
  });

  it('keys nothing that only another take has elsewhere, opened with the character or later', () => {
    const [here, there] = [restChannel(0), restChannel(2)];
    const [first, second] = [take([0, 1], here, here), { ...take([0, 1], there, there), name: 'second' }];
    const third = { ...take([0, 1], restChannel(3)), name: 'third' };
    const { wb } = workbench(documentOf({ ...bare, takes: [first, second], shownTake: 0 }));
    followOpened(wb);
    wb.store.apply(showTake, { characterId: 'c1', take: 1 });
    runAction(wb, 'key.changed');
    expect(wb.messages.passing.get()).toContain('no value was changed');
    const { document } = openFiles(
      wb.store.document,
      [{ kind: 'anim', take: third, source: { name: 'third.anim', path: 'third.anim', bytes: 1 } }],
      [],
      'c1',
    );
    wb.store.replace('Open', { document });
    expect(wasp(wb).takes[wasp(wb).shownTake]).toBe(third);
    wb.messages.passing.set(undefined);
    runAction(wb, 'key.changed');
    expect(wb.messages.passing.get()).toContain('no value was changed');
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 0, value: 5 }], timeSeconds: 0 });
    runAction(wb, 'key.changed');
    expect(wb.store.undoLabel).toBe('Key tx of hips');
  });

  it('keys the selected joint where nothing was changed, and says what to do where none is selected', () => {
    const { wb } = workbench(documentOf(bare));
    runAction(wb, 'key.changed');
    expect(wasp(wb)).toBe(bare);
    expect(wb.messages.passing.get()).toContain('no joint is selected');
    wb.store.select({ characterId: 'c1', joint: 1 });
    runAction(wb, 'key.changed');
    expect(keyCounts(wb)).toEqual([0, 0, 0, 0, 0, 0, 1, 1, 1]);
    runAction(wb, 'key.changed');
    expect(wb.messages.passing.get()).toBe('These values are already keyed at 0 s.');
  });

  it('keying from the menu is enabled only if possible: no keying without a skeleton, no removing without a take', () => {
    const always = ['key.auto', 'key.tangents.smooth', 'key.tangents.auto', 'key.tangents.linear', 'key.tangents.flat'];
    expect(enabled(workbench().wb)).toEqual(always);
    expect(enabled(workbench(documentOf(bare)).wb)).toEqual([
      'key.changed',
      'key.pose',
      'key.joint',
      ...always,
      'take.new',
    ]);
  });
});

describe('takes', () => {
  it('takes are created, duplicated and removed, each in one step', () => {
    const { wb } = workbench(documentOf(bare), { range: [1, 3] });
    const names = () => wasp(wb).takes.map((c) => c.name);
    runAction(wb, 'take.new');
    expect(wasp(wb).takes[0].range).toEqual([1, 3]);
    runAction(wb, 'take.duplicate');
    expect(names()).toEqual(['test_anim', 'test_anim_2']);
    runAction(wb, 'take.remove');
    runAction(wb, 'take.remove');
    expect(names()).toEqual([]);
    for (let i = 0; i < 4; i++) wb.store.undo();
    expect(wasp(wb)).toBe(bare);
  });

  it('the range of a take can be the playback range, or that of its keys', () => {
    const late = { ...bare, timeOffsetSeconds: 10 };
    const { wb } = workbench(documentOf({ ...late, takes: [take([0, 1], channel(2, 7))], shownTake: 0 }), {
      range: [1, 3],
    });
    runAction(wb, 'take.rangeFromPlayed');
    expect(wasp(wb).takes[0].range).toEqual([11, 13]);
    runAction(wb, 'take.rangeFromKeys');
    expect(wasp(wb).takes[0].range).toEqual([2, 7]);
  });
});

describe('the mark of a DOF', () => {
  const state = (wb: Workbench) => dofState(wb, wasp(wb), 4);

  it('distinguishes keyed now, keyed elsewhere, unkeyed changes, and free', () => {
    const { wb } = workbench(documentOf(bare));
    expect(state(wb)).toBe('free');
    toggleKey(wb, 'c1', [4]);
    expect(state(wb)).toBe('keyed');
    at(wb, 1);
    expect(state(wb)).toBe('driven');
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 4, value: 1 }], timeSeconds: 1 });
    expect(state(wb)).toBe('unkeyed');
    // Only at its own time.
    at(wb, 0);
    expect(state(wb)).toBe('keyed');
  });

  it('keys an unkeyed change, and deletes the key again', () => {
    const { wb } = workbench(documentOf(bare));
    toggleKey(wb, 'c1', [4]);
    at(wb, 1);
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 4, value: 1 }], timeSeconds: 1 });
    toggleKey(wb, 'c1', [4]);
    expect(keysOf(wasp(wb).takes[0].channels[4]).values).toEqual(Float64Array.of(0, 1));
    toggleKey(wb, 'c1', [4]);
    expect(keysOf(wasp(wb).takes[0].channels[4]).values).toEqual(Float64Array.of(0));
  });

  it('the mark of a DOF keeps the value of a channel that has lost its last key', () => {
    const { wb } = workbench(documentOf({ ...bare, pose: [0, 0, 0, 0, 0.5, 0, 0, 0, 0] }));
    toggleKey(wb, 'c1', [4]);
    toggleKey(wb, 'c1', [4]);
    expect(state(wb)).toBe('free');
    expect(wasp(wb).takes[0].channels[4]).toMatchObject({ kind: 'rest', value: 0.5 });
  });
});

/** Scripts of rare tools are fetched with their first use. */
const WHILE_LOADING = { interval: 1, timeout: 20_000 };

describe('keying a capture', () => {
  const FRAMES = 31;
  /** Both joints rotate about x, and the hips move along x. */
  const swing = (frame: number, dof: number) => ([0, 3, 6].includes(dof) ? 0.3 * Math.sin(frame / 5 + dof) : 0);
  const captured = character({ skeleton: bones, takes: [capture(9, 1 / 30, FRAMES, swing)] });
  const LEG_RX = 6;

  function posed() {
    const { wb } = workbench(documentOf(captured), { timeSeconds: 0.5, range: [0, 1] });
    wb.store.select({ characterId: 'c1', joint: 1 });
    const dofs = [{ index: LEG_RX, value: 1 }];
    wb.store.apply(setDofs, { characterId: 'c1', dofs, timeSeconds: 0.5 });
    return wb;
  }
  const valuesAt = (wb: Workbench, seconds: number) => {
    const out = new Float64Array(9);
    poseAt(wasp(wb), seconds, out);
    return out;
  };
  const offered = (wb: Workbench) => vi.waitUntil(() => wb.messages.offers[0], WHILE_LOADING);

  it('K on a capture says why not in one message, whose button converts the joint’s curves and keys, in one step', async () => {
    const wb = posed();
    const before = wb.store.document;
    const shown = valuesAt(wb, 0.5);
    runAction(wb, 'key.changed');
    const offer = await offered(wb);
    expect(wb.store.document).toBe(before);
    expect(wb.messages.passing.get()).toBe(
      'The 3 curves of leg are sampled: they have a value at every frame, and no single keys.',
    );
    expect(wb.messages.list.get()).toEqual([]);

    offer.run();
    await vi.waitUntil(() => wb.store.undoLabel === 'Convert to keys and key leg', WHILE_LOADING);
    expect(wasp(wb).unkeyed).toBeUndefined();
    const kinds = wasp(wb).takes[0].channels.map(({ kind }) => kind);
    expect(kinds).toEqual([...new Array(6).fill('samples'), 'keys', 'keys', 'keys']);
    expect(keysOf(wasp(wb).takes[0].channels[LEG_RX]).times).toContain(0.5);
    expect([...valuesAt(wb, 0.5)]).toEqual([...shown]);
    expect(Math.abs(valuesAt(wb, 0)[LEG_RX] - swing(0, LEG_RX))).toBeLessThan(0.02);
    expect(wb.messages.passing.get()).toMatch(/^Converted 3 curves to \d+ keys, at most .* off, and keyed at 0.5 s\.$/);
    wb.store.undo();
    expect(wb.store.document).toBe(before);
  });

  it('from then on K keys that joint as any other', async () => {
    const wb = posed();
    runAction(wb, 'key.changed');
    (await offered(wb)).run();
    await vi.waitUntil(() => wb.store.undoLabel === 'Convert to keys and key leg', WHILE_LOADING);
    at(wb, 0.7);
    wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: LEG_RX, value: 2 }], timeSeconds: 0.7 });
    runAction(wb, 'key.changed');
    expect(keysOf(wasp(wb).takes[0].channels[LEG_RX]).times).toContain(0.7);
    expect(wb.store.undoLabel).toBe('Key rx of leg');
  });

  it('what can be keyed is keyed, and the rest offered', async () => {
    const [changed] = captured.takes;
    const channels = changed.channels.map((one, dof) => (dof === LEG_RX + 1 ? channel(0, 1) : one));
    const { wb } = workbench(documentOf({ ...captured, takes: [{ ...changed, channels }] }), { timeSeconds: 0.5 });
    runAction(wb, 'key.pose');
    await offered(wb);
    expect([...keysOf(wasp(wb).takes[0].channels[LEG_RX + 1]).times]).toEqual([0, 0.5, 1]);
    expect(wb.messages.passing.get()).toContain('The 8 curves of 2 joints are sampled');
  });

  it('nothing on a capture says that K keys it', () => {
    const wb = posed();
    wb.store.undo();
    wb.store.select({ characterId: 'c1' });
    runAction(wb, 'key.changed');
    expect(wb.messages.passing.get()).toContain('Nothing to key');
    expect(wb.messages.passing.get()).not.toContain('keys the whole pose');
    expect(wb.messages.offers[0]).toBeUndefined();
  });

  it('with auto-key on, a change over samples offers the same, and no other change does', async () => {
    const { wb } = workbench(documentOf(captured), { timeSeconds: 0.5 });
    offerOverSamples(wb);
    const set = (key: ReturnType<typeof autoKey>) =>
      wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: LEG_RX, value: 1 }], timeSeconds: 0.5, key });
    set(autoKey(wb));
    wb.store.undo();
    expect(wb.messages.count).toBe(0);
    wb.timeline.autoKey.set(true);
    set(autoKey(wb));
    (await offered(wb)).run();
    await vi.waitUntil(() => wb.store.undoLabel === 'Convert to keys and key leg', WHILE_LOADING);
    expect(keysOf(wasp(wb).takes[0].channels[LEG_RX]).times).toContain(0.5);
  });

  it('the mark of a sampled DOF offers the same', async () => {
    const wb = posed();
    toggleKey(wb, 'c1', [LEG_RX]);
    expect((await offered(wb)).label).toBe('Convert to keys and key');
  });
});
