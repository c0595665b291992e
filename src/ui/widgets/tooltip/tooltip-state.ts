/**
 * When a tooltip shows and hides, without a DOM or a clock: each event gives the next state. By WCAG 1.4.13 a tooltip
 * can be dismissed, the pointer can move onto it, and it stays until pointer or focus leave.
 */

/** Delay before the first tooltip shows, and of a long press. */
export const REST_MS = 500;
/** Time for the pointer to cross the gap between an element and its tooltip. */
export const LEAVE_MS = 120;
/** For this long after one was hidden, the next shows at once. */
export const WARM_MS = 300;

/** What made it show. */
export type TooltipCause = 'hover' | 'focus' | 'touch';

export type TooltipState<T> =
  | {
      readonly kind: 'hidden';
      /** Until then the next one needs no rest. */
      readonly warmUntilMs: number;
      /** Dismissed while the pointer is on it: shows again only after the pointer was elsewhere. */
      readonly dismissed?: T;
    }
  | { readonly kind: 'waiting'; readonly target: T; readonly cause: TooltipCause; readonly atMs: number }
  | { readonly kind: 'shown'; readonly target: T; readonly cause: TooltipCause; readonly leavesAtMs?: number };

export type TooltipEvent<T> =
  /** A mouse or pen is over an element with a tooltip, or over none. */
  | { readonly kind: 'over'; readonly target: T | undefined }
  /** The pointer is over the tooltip itself. */
  | { readonly kind: 'onTooltip' }
  /** The keyboard focused an element with a tooltip, or one without. */
  | { readonly kind: 'focus'; readonly target: T | undefined }
  /** A finger was put on it. */
  | { readonly kind: 'hold'; readonly target: T }
  /** The finger was lifted. */
  | { readonly kind: 'lift' }
  /** A press, Escape, scrolling, the window left, or the element gone. */
  | { readonly kind: 'dismiss' }
  /** The time of `dueAt` has come. */
  | { readonly kind: 'time' };

export const NO_TOOLTIP = { kind: 'hidden', warmUntilMs: Number.NEGATIVE_INFINITY } as const;

export function nextTooltip<T>(state: TooltipState<T>, event: TooltipEvent<T>, nowMs: number): TooltipState<T> {
  switch (event.kind) {
    case 'over':
      return over(state, event.target, nowMs);
    case 'onTooltip':
      return state.kind === 'shown' ? staying(state) : state;
    case 'focus':
      if (event.target !== undefined) return { kind: 'shown', target: event.target, cause: 'focus' };
      return state.kind === 'shown' && state.cause === 'focus' ? NO_TOOLTIP : state;
    case 'hold':
      return { kind: 'waiting', target: event.target, cause: 'touch', atMs: nowMs + REST_MS };
    case 'lift':
      return state.kind === 'waiting' && state.cause === 'touch' ? NO_TOOLTIP : state;
    case 'dismiss':
      return state.kind === 'hidden' ? state : { ...NO_TOOLTIP, dismissed: state.target };
    case 'time': {
      if (nowMs < (dueAt(state) ?? Number.POSITIVE_INFINITY)) return state;
      if (state.kind === 'waiting') return { kind: 'shown', target: state.target, cause: state.cause };
      return { kind: 'hidden', warmUntilMs: nowMs + WARM_MS };
    }
  }
}

/** When `time` is to be sent, in the milliseconds of `nowMs`; undefined if nothing is due. */
export function dueAt<T>(state: TooltipState<T>): number | undefined {
  if (state.kind === 'waiting') return state.atMs;
  return state.kind === 'shown' ? state.leavesAtMs : undefined;
}

function over<T>(state: TooltipState<T>, target: T | undefined, nowMs: number): TooltipState<T> {
  switch (state.kind) {
    case 'hidden':
      if (target === undefined) return state.dismissed === undefined ? state : NO_TOOLTIP;
      if (target === state.dismissed) return state;
      if (nowMs < state.warmUntilMs) return { kind: 'shown', target, cause: 'hover' };
      return { kind: 'waiting', target, cause: 'hover', atMs: nowMs + REST_MS };
    case 'waiting':
      if (target === state.target) return state;
      return target === undefined ? NO_TOOLTIP : { kind: 'waiting', target, cause: 'hover', atMs: nowMs + REST_MS };
    case 'shown':
      if (target === state.target) return staying(state);
      if (target !== undefined) return { kind: 'shown', target, cause: 'hover' };
      if (state.cause !== 'hover' || state.leavesAtMs !== undefined) return state;
      return { ...state, leavesAtMs: nowMs + LEAVE_MS };
  }
}

function staying<T>(state: TooltipState<T> & { readonly kind: 'shown' }): TooltipState<T> {
  if (state.leavesAtMs === undefined) return state;
  return { kind: 'shown', target: state.target, cause: state.cause };
}
