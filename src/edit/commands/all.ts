/** Every command of the document. */
import type { AnyCommand } from '../command.ts';
import * as attach from './beside/attach.ts';
import * as layers from './beside/layers.ts';
import * as limbs from './beside/limbs.ts';
import * as sets from './beside/sets.ts';
import * as channels from './channels.ts';
import * as couples from './couples.ts';
import * as drags from './drags/drags.ts';
import { COMMANDS_AT_HAND, commandsIn } from './first-commands.ts';
import * as heights from './heights.ts';
import * as hold from './hold.ts';
import * as ik from './ik.ts';
import * as keys from './keys.ts';
import * as markers from './markers.ts';
import * as moment from './moment.ts';
import * as paste from './paste.ts';
import * as poses from './poses.ts';
import * as retarget from './retarget.ts';
import * as review from './review.ts';
import * as rig from './rig.ts';
import * as rigJoint from './rig-joint.ts';
import * as samples from './samples.ts';
import * as skinWeights from './skin-weights.ts';
import * as takeEdits from './take-edits.ts';
import * as takeJoins from './take-joins.ts';
import * as takes from './takes.ts';
import * as tangents from './tangents.ts';

/** By their ids. */
export const ALL_COMMANDS: ReadonlyMap<string, AnyCommand> = new Map([
  ...COMMANDS_AT_HAND,
  ...commandsIn([keys, paste, tangents, review, takes, takeEdits, takeJoins, markers, moment, channels, samples]),
  ...commandsIn([
    attach,
    layers,
    limbs,
    retarget,
    poses,
    ik,
    hold,
    rig,
    rigJoint,
    couples,
    skinWeights,
    heights,
    sets,
    drags,
  ]),
]);

/** The arguments of each command in words, for `marrow.commands()`. */
export function commandList(): readonly CommandInfo[] {
  return [...ALL_COMMANDS].map(([id, { args }]) => ({
    id,
    arguments: Object.fromEntries(
      Object.entries(args).map(([name, { what, isOptional }]) => [
        name,
        isOptional ? `${what}; may be left out` : what,
      ]),
    ),
  }));
}

/** A command as `marrow.commands()` lists it. */
export interface CommandInfo {
  readonly id: string;
  /** By name, what each must be. */
  readonly arguments: Readonly<Record<string, string>>;
}
