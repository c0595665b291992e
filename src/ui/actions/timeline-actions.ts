/** How the timeline is looked at: tabs, fitting, which channels are shown. */
import type { Action } from './action.ts';

export const TIMELINE_ACTIONS: readonly Action[] = [];
