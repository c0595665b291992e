/** Making keys from the pose, and what takes are there. */
import type { Action } from './action.ts';

export const KEYING_ACTIONS: readonly Action[] = [];
