/** Every action in many states of the page: it does something that can be noticed, or says why not. */
import { afterAll, beforeAll, describe, expect, it, vi } from 'vitest';
import { setDofs } from '../../../src/edit/commands/pose.ts';
import { copyKeys } from '../../../src/edit/keys/clipboard.ts';
import type { Document } from '../../../src/model/document.ts';
import { restChannel, SAMPLED } from '../../../src/model/takes/take.ts';
import { actionsOf, isChecked, isEnabled, tryAction } from '../../../src/ui/state/actions/action.ts';
import { watchEffect } from '../../../src/ui/state/actions/effect.ts';
import { DumpComparison } from '../../../src/ui/state/dump-comparison.ts';
import type { Action, Workbench } from '../../../src/ui/state/workbench.ts';
import { channel, character, documentOf, skeleton, take, workbench } from '../builders.ts';

const bones = skeleton(['hips', -1], ['leg_l', 0], ['foot_l', 1], ['leg_r', 0]);
const DOFS = 3 + 3 * 4;
const loop = { ...channel(0, 0.5, 1), extrapolateIn: 'cycle', extrapolateOut: 'cycle' } as const;
const walking = character({ skeleton: bones, takes: [take([0, 2], ...Array.from({ length: DOFS }, () => loop))] });
const bare = character({ skeleton: bones, shownTake: -1 });
const capture = {
  ...take([0, 1], ...Array.from({ length: DOFS }, () => SAMPLED)),
  samples: {
    frameCount: 31,
    frameSeconds: 1 / 30,
    startSeconds: 0,
    firstChannel: 0,
    values: new Float64Array(31 * DOFS),
    scales: new Float64Array(DOFS).fill(1),
    interpolation: 'linear',
  },
} as const;
const captured = character({ skeleton: bones, takes: [capture] });

interface Given {
  readonly document?: Document;
  prepare?(wb: Workbench): void;
}

const joint = (wb: Workbench) => wb.store.select({ characterId: 'c1', joint: 1 });
const joints = (wb: Workbench) => wb.store.select({ characterId: 'c1', joint: 1, others: [3] });
const keys = (wb: Workbench) => {
  wb.store.select({ characterId: 'c1', joint: 1, keys: [{ channel: 6, indices: [1] }] });
  wb.timeline.copied = copyKeys(walking.takes[0], [{ channel: 7, indices: [0, 1] }]);
};
const STATES: Readonly<Record<string, Given>> = {
  'an empty stage': {},
  'a walker of which nothing is selected': { document: documentOf(walking) },
  'a walker with a selected joint': { document: documentOf(walking), prepare: joint },
  'a walker with selected and copied keys': { document: documentOf(walking), prepare: keys },
  'a walker in the dope sheet': {
    document: documentOf(walking),
    prepare(wb) {
      keys(wb);
      wb.timeline.change({ tab: 'dope' });
    },
  },
  'an unkeyed change at a time outside the cycles': {
    document: documentOf(walking),
    prepare(wb) {
      wb.transport.update((p) => ({ ...p, timeSeconds: 1.5 }));
      wb.store.apply(setDofs, { characterId: 'c1', dofs: [{ index: 6, value: 1 }], timeSeconds: 1.5 });
    },
  },
  'a joint without keys, and keys copied from another': {
    document: documentOf({
      ...walking,
      takes: [take([0, 2], ...Array.from({ length: DOFS }, (_, c) => (c < 9 ? loop : restChannel())))],
    }),
    prepare(wb) {
      keys(wb);
      wb.store.select({ characterId: 'c1', joint: 2 });
    },
  },
  'several selected joints': { document: documentOf(walking), prepare: joints },
  'several selected joints in rig mode': {
    document: documentOf(bare),
    prepare(wb) {
      joints(wb);
      wb.posing.mode.set('rig');
    },
  },
  'several selected joints in IK mode': {
    document: documentOf(walking),
    prepare(wb) {
      joints(wb);
      wb.posing.mode.set('ik');
    },
  },
  'a character without a take': { document: documentOf(bare), prepare: joint },
  'a capture': { document: documentOf(captured), prepare: joint },
  'a lone skin': { document: documentOf(character({ shownTake: -1 })) },
  'IK mode': {
    document: documentOf(walking),
    prepare(wb) {
      joint(wb);
      wb.posing.mode.set('ik');
    },
  },
  'rig mode': {
    document: documentOf(bare),
    prepare(wb) {
      joint(wb);
      wb.posing.mode.set('rig');
    },
  },
  'a comparison with a dump': {
    document: documentOf(walking),
    prepare(wb) {
      wb.comparing.set(new DumpComparison(wb, 'c1', [], () => new Promise(() => {})));
    },
  },
  'several characters': { document: documentOf(walking, { ...bare, id: 'c2', name: 'bee' }), prepare: joint },
};

/** What the page has that the document doesn't: drawing, files and the tab below. Asking it something is no effect. */
const QUESTIONS =
  /^(character|placementOf|sizeOf|freezeRootMotion|pickedCopy|canReload|samples|unsaved|stats|canvas|eye)$/;

function recorded(target: object, calls: string[]): object {
  return new Proxy(target, {
    get(own, name) {
      const value: unknown = Reflect.get(own, name);
      if (value !== undefined && typeof value !== 'function') return value;
      return (...args: unknown[]) => {
        if (!QUESTIONS.test(String(name))) calls.push(String(name));
        return typeof value === 'function' ? Reflect.apply(value, own, args) : undefined;
      };
    },
  });
}

/** The values of all observables of a part of the page, those of its parts too. */
function observed(part: object): readonly unknown[] {
  return Object.values(part).flatMap((own: unknown) => {
    if (typeof own !== 'object' || own === null) return [];
    if ('subscribe' in own && 'get' in own && typeof own.get === 'function') return [own.get()];
    return own.constructor === Object || /Hand$/.test(own.constructor.name) ? observed(own) : [];
  });
}

/** What became of an action; undefined if nobody could tell. */
async function outcome({ document, prepare }: Given, id: string): Promise<string | undefined> {
  const { wb } = workbench(document);
  const calls: string[] = [];
  const { viewport } = wb;
  const [camera, pointing] = [viewport.camera, viewport.pointing].map((part) => recorded(part, calls));
  Object.assign(wb, { viewport: recorded({ ...viewport, camera, pointing }, calls), files: recorded(wb.files, calls) });
  Object.assign(wb.timeline, { tab: recorded({}, calls) });
  prepare?.(wb);
  const action: Action | undefined = actionsOf(wb).find((a) => a.id === id);
  if (!action) throw new Error(`There is no ${id} in this state.`);
  const isOn = isEnabled(wb, action);
  const isChosen = action.radio && isChecked(wb, action);
  calls.length = 0;
  const hasEffect = watchEffect(wb);
  const before = [...observed(wb.timeline), ...observed(wb.posing)];
  // As `tryAction` does it, and waits for what is loaded first.
  const running: Promise<void>[] = [];
  tryAction(wb, {
    ...action,
    run(page, args) {
      const made = action.run(page, args);
      if (made) running.push(made);
      return made;
    },
  });
  await Promise.allSettled(running);
  await Promise.resolve();
  const says = wb.messages.passing.get() ?? '';
  const isChanged = [...observed(wb.timeline), ...observed(wb.posing)].some((now, i) => now !== before[i]);
  if (isChanged && says.endsWith('nothing to change.')) throw new Error(`${id} changed the page, and says: ${says}`);
  if (calls.length > 0 && says.endsWith('nothing to change.')) throw new Error(`${id} did ${calls}, and says: ${says}`);
  if (hasEffect() || calls.length > 0) return isOn ? 'done' : 'refused';
  return action.quiet || isChosen ? 'as it was' : undefined;
}

describe('every action', () => {
  // Long work is done in slices of some milliseconds: here the first one does all, however busy the machine is.
  beforeAll(() => void vi.spyOn(performance, 'now').mockReturnValue(0));
  afterAll(() => void vi.restoreAllMocks());

  it.each(Object.entries(STATES))('every action is done or says why not: %s', async (_, given) => {
    const silent: string[] = [];
    for (const { id } of actionsOf(workbench(given.document).wb)) {
      if ((await outcome(given, id)) === undefined) silent.push(id);
    }
    expect(silent).toEqual([]);
  });
});
