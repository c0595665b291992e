/** Every command on the document by its id, for whoever asks by name: the console, scripts, tests. */
import type { Document } from '../../model/document.ts';
import type { Command, Edit } from '../store.ts';
import { COMMANDS_AT_HAND } from './at-hand.ts';
import { bakeExtrapolation, eulerFilter, makeLoop, resample, simplify } from './channels.ts';
import { bakeRetarget, changeRetarget, clearRetarget, setRetarget } from './retarget.ts';
import {
  convertToKeys,
  cropSamples,
  resampleSamples,
  reverseSamples,
  smoothSamples,
  splitSamples,
  trimSamples,
} from './samples.ts';

/** Those that the page fetches first; by their ids it knows them (`isFetched`). */
const FETCHED: readonly Command<never, Document | Edit>[] = [
  simplify,
  resample,
  eulerFilter,
  bakeExtrapolation,
  makeLoop,
  cropSamples,
  trimSamples,
  splitSamples,
  resampleSamples,
  reverseSamples,
  smoothSamples,
  convertToKeys,
  setRetarget,
  changeRetarget,
  clearRetarget,
  bakeRetarget,
];

export const COMMANDS_BY_ID: ReadonlyMap<string, Command<never, Document | Edit>> = new Map([
  ...COMMANDS_AT_HAND,
  ...FETCHED.map((c) => [c.id, c] as const),
]);
