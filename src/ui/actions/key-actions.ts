/** What is done to selected keys and shown channels. */
import type { Action } from './action.ts';

export const KEY_ACTIONS: readonly Action[] = [];
