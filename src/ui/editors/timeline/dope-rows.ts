/**
 * The rows of the dope sheet, from the character and the expanded groups:
 *
 *     All keys                    summary: whole poses
 *     Follows hand_r of Walker    if it is attached: spans instead of keys
 *     ▸ Root translation          tx ty tz
 *     ▾ hips                      joints in the skeleton's order
 *         rx
 *     ▸ Morphs
 *     ▸ Goal of leg_l             of each limb that the take moves to one
 *     ▸ More channels             if the take has more than the character has DOFs
 *
 * A row is a list of channels, which determines what is drawn, hit or selected in it. Joints are a flat list, not a
 * tree: this view is about timing, and in a tree a hand would be ten levels deep.
 */
import { silentChannels } from '../../../evaluate/retarget/moved-dofs.ts';
import type { Character } from '../../../model/document.ts';
import { type AxisLetter, axisOfDof } from '../../../model/skeleton/dof-axis.ts';
import { type CharacterDof, rootDofCount } from '../../../model/skeleton/dofs.ts';
import { jointName, shortJointName } from '../../../model/skeleton/joint-name.ts';
import type { DofUnit } from '../../../model/skeleton/skeleton.ts';
import { motionsOf } from '../../../model/takes/layers.ts';
import { type Attachment, GOAL_CHANNELS, type Take } from '../../../model/takes/take.ts';
import { dofsFor, followedName, GOAL, takeInTimeline } from './channels.ts';

/** Keys of groups other than joints in `TimelineView.unfolded`. */
export const ROOT_FOLD = -1;
export const MORPHS_FOLD = -2;
export const OTHERS_FOLD = -3;
/** That of the first goal; the others have lower ones. */
const GOALS_FOLD = -4;

export type DopeRowKind =
  | 'summary'
  | 'character'
  | 'attached'
  | 'root'
  | 'joint'
  | 'morphs'
  | 'goal'
  | 'others'
  | 'channel';

export interface DopeRow {
  /** Unique among the rows, and stable from one list to the next. */
  readonly key: string;
  readonly kind: DopeRowKind;
  /** Empty if the file gives no name. */
  readonly label: string;
  /** 1 for rows of an expanded group. */
  readonly depth: 0 | 1;
  /** Channels of the take, ascending, including those without keys. */
  readonly channels: readonly number[];
  /** The character that it is of, where rows of several are listed. */
  readonly characterId?: string;
  /** First and last of its samples, seconds of the transport, where they are of another take than the active one. */
  readonly sampled?: readonly [number, number];
  /** Its key in `TimelineView.unfolded`; absent if it can't be expanded. */
  readonly fold?: number;
  readonly expanded: boolean;
  /** The joint that a click on the name selects. */
  readonly joint?: number;
  /** Unit of a single channel. */
  readonly unit?: DofUnit;
  /** Axis that colours a single channel. */
  readonly axis?: AxisLetter;
  /** The DOF that a single linked channel follows, or the first one if all channels of a row are linked. */
  readonly follows?: string;
}

export interface RowOptions {
  /** See `TimelineView.unfolded`. */
  readonly unfolded: readonly number[];
  /** Includes rows without any key or sample. */
  readonly all: boolean;
  /** Part of a joint's, morph's or channel's name ("rx", "hand rx"); empty: all. */
  readonly filter: string;
}

interface Group {
  readonly kind: 'root' | 'joint' | 'morphs' | 'goal' | 'others';
  readonly fold: number;
  readonly label: string;
  readonly joint?: number;
  /** Index of the first channel, and their number. */
  readonly first: number;
  readonly count: number;
}

/** The rows, the summary first; empty if the take has no channels to show. */
export function dopeRows(character: Character, take: Take, options: RowOptions): DopeRow[] {
  const { channels } = take;
  const dofs = dofsFor(character);
  const words = options.filter.toLowerCase().split(/\s+/).filter(Boolean);
  const unfolded = new Set(options.unfolded);
  const rows: DopeRow[] = [];
  const listed: number[] = [];
  for (const group of groupsOf(character, dofs, channels.length)) {
    const within = channelRows(group, character, dofs, take, options.all);
    const matching = words.length
      ? within.filter((row) => {
          const name = `${group.label} ${row.label}`.toLowerCase();
          return words.every((word) => name.includes(word));
        })
      : within;
    if (!matching.length) continue;
    // If the filter matches some DOFs of a group, show which.
    const expanded = unfolded.has(group.fold) || matching.length < within.length;
    const { kind, fold, label, joint } = group;
    const own = matching.map((row) => row.channels[0]);
    // A collapsed row shows it if all its channels are linked.
    const follows = matching.every((one) => one.follows !== undefined) ? matching[0].follows : undefined;
    const row: DopeRow = {
      ...{ key: `${kind}/${fold}`, kind, label, depth: 0, channels: own, fold, expanded },
      ...(follows !== undefined && { follows }),
    };
    rows.push(joint === undefined ? row : { ...row, joint });
    if (expanded) rows.push(...matching);
    listed.push(...own);
  }
  const attached = words.length ? [] : attachedRows(character, take);
  if (!rows.length && !attached.length) return [];
  const summary: DopeRow = { key: 'summary', kind: 'summary', label: '', depth: 0, channels: listed, expanded: false };
  return [summary, ...attached, ...rows];
}

/** `hand_r of Walker`: what an attachment follows. */
export function leadingJoint({ leaders = [] }: Character, { leaderId, joint }: Attachment): string {
  const leader = leaders.find(({ id }) => id === leaderId);
  return leader ? `${jointName(leader.skeleton, joint)} of ${leader.name}` : '';
}

/** One row for all attachments. */
function attachedRows(character: Character, { attached }: Take): readonly DopeRow[] {
  if (!attached) return [];
  const names = new Set(attached.list.map((one) => leadingJoint(character, one)));
  const label = `Follows ${[...names].join(', ')}`;
  return [{ key: 'attached', kind: 'attached', label, depth: 0, channels: [], expanded: false }];
}

/** The channels with keys or samples that the rows would contain, ascending. */
export function keyedChannels(character: Character, filter: string): number[] {
  const take = takeInTimeline(character);
  if (!take) return [];
  return [...(dopeRows(character, take, { unfolded: [], all: false, filter })[0]?.channels ?? [])];
}

/** Whether two takes of one character have the same rows: moved keys don't rebuild them. */
export function sameRows(a: Take, b: Take): boolean {
  if (a === b) return true;
  if (a.channels.length !== b.channels.length || a.attached !== b.attached) return false;
  // Rows have the names of limbs.
  if (a.goals?.list.some(({ limb }, g) => limb !== b.goals?.list[g]?.limb)) return false;
  const isSame = a.layers === b.layers;
  return a.channels.every((c, i) => (isSame && c === b.channels[i]) || isAnimated(a, i) === isAnimated(b, i));
}

/** All groups that can be expanded for a character with such a take. */
export function allFolds(character: Character, take: Take): number[] {
  const dofs = dofsFor(character);
  return groupsOf(character, dofs, take.channels.length).map((g) => g.fold);
}

/** In channel order, which is DOF order; up to the take's last. Without channels that have no effect. */
function groupsOf(character: Character, dofs: readonly CharacterDof[], channelCount: number): Group[] {
  const groups: Group[] = [];
  const silent = silentChannels(character);
  const add = (group: Group) => {
    const count = Math.min(group.count, channelCount - group.first);
    if (count > 0 && group.first >= silent) groups.push({ ...group, count });
  };
  const root = rootDofCount(character.skeleton);
  add({ kind: 'root', fold: ROOT_FOLD, label: 'Root translation', first: 0, count: root, ...rootJoint(character) });
  let first = root;
  while (first < dofs.length) {
    const { joint } = dofs[first];
    if (joint === GOAL) break;
    let end = first + 1;
    while (end < dofs.length && dofs[end].joint === joint) end++;
    const count = end - first;
    if (joint < 0) add({ kind: 'morphs', fold: MORPHS_FOLD, label: 'Morphs', first, count });
    else {
      const name = character.skeleton?.joints[joint].name ?? '';
      const label = name && shortJointName(character.skeleton, joint);
      add({ kind: 'joint', fold: joint, label, joint, first, count });
    }
    first = end;
  }
  const { goals } = takeInTimeline(character) ?? {};
  goals?.list.forEach(({ limb }, g) => {
    const count = GOAL_CHANNELS.length;
    const last = character.limbs?.list.find(({ name }) => name === limb)?.joints.at(-1);
    const label = `Goal of ${limb}`;
    add({ kind: 'goal', fold: GOALS_FOLD - g, label, first, count, ...(last !== undefined && { joint: last }) });
    first += count;
  });
  const left = channelCount - first;
  add({ kind: 'others', fold: OTHERS_FOLD, label: 'More channels', first, count: left });
  return groups;
}

/** The root translation belongs to the root joint, as in the inspector. */
function rootJoint(character: Character): { readonly joint?: number } {
  return character.skeleton?.joints.length ? { joint: 0 } : {};
}

function channelRows(
  { kind, first, count, joint }: Group,
  character: Character,
  dofs: readonly CharacterDof[],
  take: Take,
  all: boolean,
): DopeRow[] {
  const rows: DopeRow[] = [];
  for (let c = first; c < first + count; c++) {
    if (!all && !isAnimated(take, c)) continue;
    const dof = kind === 'others' ? undefined : dofs[c];
    // The row above names the limb.
    const label = dof ? (kind === 'goal' ? GOAL_CHANNELS[c - first] : dof.name) : `channel ${c}`;
    const row: DopeRow = { key: `channel/${c}`, kind: 'channel', label, depth: 1, channels: [c], expanded: false };
    const axis = dof && axisOfDof(character.skeleton, dof);
    const follows = followedName(character, c);
    rows.push({
      ...row,
      ...(joint !== undefined && { joint }),
      ...(dof && { unit: dof.unit }),
      ...(axis && { axis }),
      ...(follows !== undefined && { follows }),
    });
  }
  return rows;
}

/** By itself, or below the active layer or above it: its row shows faintly what is there. */
function isAnimated(take: Take, channel: number): boolean {
  if (take.channels[channel].kind !== 'rest') return true;
  return (
    take.layers !== undefined && motionsOf(take).some(({ channels }) => (channels[channel]?.kind ?? 'rest') !== 'rest')
  );
}
