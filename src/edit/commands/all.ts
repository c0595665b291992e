/** Every command on the document by its id, for whoever asks by name: the console, scripts, tests. */
import type { Document } from '../../model/document.ts';
import type { Command, Edit } from '../store.ts';
import {
  addCopy,
  placeCharacter,
  removeCharacter,
  removeCopy,
  renameCharacter,
  setTimeOffset,
  showClip,
  showSkin,
} from './characters.ts';
import { resetPose, setClamping, setDofs } from './pose.ts';

/** Arguments come from outside here: each command checks its own and refuses with a `CommandError`. */
const COMMANDS: readonly Command<never, Document | Edit>[] = [
  setDofs,
  resetPose,
  setClamping,
  removeCharacter,
  renameCharacter,
  showSkin,
  showClip,
  setTimeOffset,
  placeCharacter,
  addCopy,
  removeCopy,
];

export const COMMANDS_BY_ID: ReadonlyMap<string, Command<never, Document | Edit>> = new Map(
  COMMANDS.map((c) => [c.id, c]),
);
