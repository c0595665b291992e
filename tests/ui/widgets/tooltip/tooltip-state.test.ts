import { expect, it } from 'vitest';
import {
  dueAt,
  LEAVE_MS,
  NO_TOOLTIP,
  nextTooltip,
  REST_MS,
  type TooltipEvent,
  type TooltipState,
  WARM_MS,
} from '../../../../src/ui/widgets/tooltip/tooltip-state.ts';

type Step = readonly [atMs: number, event: TooltipEvent<string>];
const over = (target?: string): TooltipEvent<string> => ({ kind: 'over', target });
const focus = (target?: string): TooltipEvent<string> => ({ kind: 'focus', target });
const time: TooltipEvent<string> = { kind: 'time' };
const dismiss: TooltipEvent<string> = { kind: 'dismiss' };

/** What is shown after these events, if anything. */
function after(...steps: readonly Step[]): {
  readonly shown: string | undefined;
  readonly state: TooltipState<string>;
} {
  const state = steps.reduce<TooltipState<string>>((s, [at, event]) => nextTooltip(s, event, at), NO_TOOLTIP);
  return { shown: state.kind === 'shown' ? state.target : undefined, state };
}

const shown: readonly Step[] = [
  [0, over('a')],
  [REST_MS, time],
];

it('a tooltip shows when the pointer has rested, and not before', () => {
  expect(after([0, over('a')]).shown).toBeUndefined();
  expect(after([0, over('a')], [REST_MS - 1, time]).shown).toBeUndefined();
  expect(after(...shown).shown).toBe('a');
  expect(dueAt(after([0, over('a')]).state)).toBe(REST_MS);
});

it('a pointer that passes over an element shows no tooltip', () => {
  expect(after([0, over('a')], [100, over()], [REST_MS, time]).shown).toBeUndefined();
  expect(after([0, over('a')], [400, over('b')], [REST_MS, time]).shown).toBeUndefined();
});

it('the tooltip of a neighbour shows at once, also across a gap', () => {
  expect(after(...shown, [600, over('b')]).shown).toBe('b');
  const gone: readonly Step[] = [...shown, [600, over()], [600 + LEAVE_MS, time]];
  expect(after(...gone).shown).toBeUndefined();
  expect(after(...gone, [600 + LEAVE_MS + WARM_MS - 1, over('b')]).shown).toBe('b');
  expect(after(...gone, [600 + LEAVE_MS + WARM_MS, over('b')]).shown).toBeUndefined();
});

it('a tooltip stays while the pointer is on it or comes back in time', () => {
  expect(after(...shown, [600, over()], [650, { kind: 'onTooltip' }], [2000, time]).shown).toBe('a');
  expect(after(...shown, [600, over()], [650, over('a')], [2000, time]).shown).toBe('a');
  expect(after(...shown, [600, over()], [600 + LEAVE_MS, time]).shown).toBeUndefined();
});

it('moving on outside does not put off that a tooltip hides', () => {
  expect(dueAt(after(...shown, [600, over()], [690, over()]).state)).toBe(600 + LEAVE_MS);
});

it('a dismissed tooltip shows again only after the pointer was elsewhere', () => {
  const dismissed: readonly Step[] = [...shown, [600, dismiss]];
  expect(after(...dismissed).shown).toBeUndefined();
  expect(after(...dismissed, [700, over('a')], [5000, time]).shown).toBeUndefined();
  expect(after(...dismissed, [700, over()], [800, over('a')], [800 + REST_MS, time]).shown).toBe('a');
  // Pressed before it showed.
  expect(after([0, over('a')], [100, dismiss], [200, over('a')], [5000, time]).shown).toBeUndefined();
});

it('focus shows a tooltip at once, until the focus leaves', () => {
  expect(after([0, focus('a')]).shown).toBe('a');
  expect(after([0, focus('a')], [10, over()], [5000, time]).shown).toBe('a');
  expect(after([0, focus('a')], [10, focus('b')]).shown).toBe('b');
  expect(after([0, focus('a')], [10, focus()]).shown).toBeUndefined();
  expect(after(...shown, [600, focus()]).shown).toBe('a');
});

it('a finger that holds shows a tooltip, which stays when it is lifted; a tap shows none', () => {
  const held: readonly Step[] = [[0, { kind: 'hold', target: 'a' }]];
  expect(after(...held, [100, { kind: 'lift' }], [REST_MS, time]).shown).toBeUndefined();
  const lifted: readonly Step[] = [...held, [REST_MS, time], [900, { kind: 'lift' }]];
  expect(after(...lifted, [9000, time]).shown).toBe('a');
  expect(after(...lifted, [9000, dismiss]).shown).toBeUndefined();
});
