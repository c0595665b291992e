import { expect, it } from 'vitest';
import { ACTIONS } from '../../../src/ui/shell/actions.ts';
import { advanced, GUIDE_TEXTS, type GuideState } from '../../../src/ui/shell/help/guides/steps.ts';
import { problemPage } from '../../../src/ui/state/manual-link.ts';
import { character, documentOf, take } from '../builders.ts';

const start = character();
const posed = { ...start, unkeyed: { timeSeconds: 0, dofs: [0], values: [1] } };
const keyed = { ...start, takes: [...start.takes, take([0, 1])] };
const again = { ...start, takes: [...keyed.takes] };

function at(of: typeof start, more: Partial<GuideState> = {}): GuideState {
  return {
    document: documentOf(of),
    selection: {},
    isPlaying: false,
    time: 0,
    tab: undefined,
    isUnsaved: true,
    comparing: undefined,
    ...more,
  };
}

it('the first animation ticks off what is done: paused, posed, keyed, later, keyed again, curves, saved', () => {
  const guide = GUIDE_TEXTS.firstAnimation;
  const states = [
    at(start, { isPlaying: true }),
    at(start),
    at(posed),
    at(keyed),
    at(keyed, { time: 0.5 }),
    at(again, { time: 0.5 }),
    at(again, { time: 0.5, tab: 'curves' }),
    at(again, { time: 0.5, tab: 'curves', isUnsaved: false }),
  ];
  let progress = { done: 0, since: states[0] };
  const done = states.map((state) => {
    progress = advanced(guide, progress, state);
    return progress.done;
  });
  expect(done).toEqual([0, 1, 2, 3, 4, 5, 6, 7]);
  expect(guide.steps.length).toBe(7);
});

it('a step that is met when it begins is done at once, and nothing is done twice', () => {
  const guide = GUIDE_TEXTS.firstAnimation;
  const begun = { done: 0, since: at(start) };
  expect(advanced(guide, begun, at(start)).done).toBe(1);
  const waiting = { done: 1, since: at(start) };
  expect(advanced(guide, waiting, at(start))).toBe(waiting);
  // One key poses and keys, and is not the second key.
  expect(advanced(guide, waiting, at(keyed)).done).toBe(2);
});

it('checking a program waits for a character of one’s own, for its numbers, and for better ones', () => {
  const guide = GUIDE_TEXTS.checkProgram;
  const example = { ...at(start), document: { ...documentOf(start), isOpeningSample: true } };
  expect(advanced(guide, { done: 0, since: example }, example).done).toBe(0);
  const first = {};
  const compared = at(start, { comparing: first });
  const dropped = advanced(guide, { done: 0, since: example }, compared);
  expect(dropped.done).toBe(3);
  const looked = advanced(guide, dropped, { ...compared, selection: { characterId: 'c1', joint: 1 } });
  expect(looked.done).toBe(4);
  expect(advanced(guide, looked, { ...compared, comparing: {} }).done).toBe(5);
});

it('the buttons of guides are actions of the page', () => {
  const ids = Object.values(GUIDE_TEXTS).flatMap(({ steps }) => steps.flatMap(({ action }) => action?.[1] ?? []));
  for (const id of ids)
    expect(
      ACTIONS.some((action) => action.id === id),
      id,
    ).toBe(true);
});

it.each([
  ['weights-sum', 'guide/rigging.html#bind-a-skin'],
  ['extrapolation-unknown', 'guide/curves.html#cycles-and-extrapolation'],
  ['keys-unsorted', 'guide/curves.html#curve-editor'],
  ['frame-time', 'guide/capture-and-review.html#open'],
  ['bad-unit', 'reference/files.html'],
  ['brace-missing', 'reference/files.html'],
  ['dump-shortened', 'guide/check-your-program.html#what-can-be-compared'],
])('a problem %s leads to %s in the manual', (code, page) => {
  expect(problemPage(code)?.page).toBe(page);
});
