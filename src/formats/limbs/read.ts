/**
 * `NAME.limbs.json`, our own format: limbs of the skeleton `NAME`, goals of the take `NAME`, or both.
 *
 *     { "limbs": [ { "name": "leg_l", "joints": ["thigh_l", "shin_l", "foot_l"], "tip": [0, 0, 0], "orient": true,
 *                    "bend": { "dof": "rx", "sign": 1 } } ] }
 *     { "base": "walk.base.anim", "flattened": { "file": "walk.anim", "sha256": "64 hex digits" },
 *       "goals": [ { "limb": "leg_l", "space": [[0, "world"], [1.2, "hand_r"]],
 *                    "channels": { "blend": 1, "tx": { "keys": [[0, 0.1, "flat", "flat"]] } } } ] }
 */
import type { Bend, LimbByName } from '../../model/limbs.ts';
import { WORLD_SPACE } from '../../model/takes/goals.ts';
import type { LimbsFile } from '../../model/takes/limbs-file.ts';
import { GOAL_CHANNELS, type Goal, type GoalCurve, type SpaceKey } from '../../model/takes/take.ts';
import { readCurve } from '../json/curve.ts';
import { readFlattened } from '../json/flattened.ts';
import { type JsonValue, jsonReader } from '../json/read.ts';
import { WHOLE_FILE } from '../places.ts';
import type { Reader } from '../reader.ts';
import type { Report } from '../report.ts';

/** A reader of `.limbs.json`. */
export function limbsReader(fileName: string): Reader<LimbsFile> {
  return jsonReader(fileName, 'limbs-wrong', (file, report) => {
    const object = file.object();
    const [limbs, goals] = [object.optional('limbs')?.list(), object.optional('goals')?.list()];
    if (!limbs && !goals) file.wrong('{ "limbs": […] } or { "base": …, "goals": […] }');
    const base = goals ? object.field('base').text() : object.optional('base')?.text();
    const flattened = object.optional('flattened');
    const own = limbs?.map(limbOf);
    const ofTake = goals?.map((goal) => goalOf(goal, report));
    if (limbs && own) refuseTwice(limbs, 'name', own, ({ name }) => name);
    if (goals && ofTake) refuseTwice(goals, 'limb', ofTake, ({ limb }) => limb);
    return {
      ...(own && { limbs: own }),
      ...(ofTake && { goals: ofTake }),
      ...(base !== undefined && { base }),
      ...(flattened && { flattened: readFlattened(flattened) }),
      ...object.others(),
    };
  });
}

function refuseTwice<T>(
  rows: readonly JsonValue[],
  field: string,
  items: readonly T[],
  nameOf: (item: T) => string,
): void {
  const names = items.map(nameOf);
  const twice = names.findIndex((name, i) => names.indexOf(name) < i);
  if (twice >= 0) rows[twice].object().field(field).wrong('a name that no other has');
}

function limbOf(value: JsonValue): LimbByName {
  const object = value.object();
  const name = object.field('name').text();
  const joints = object
    .field('joints')
    .list()
    .map((joint) => joint.text());
  const tip = object.optional('tip');
  const orient = object.optional('orient')?.boolean() ?? false;
  // Only a limb of three joints has one in the middle.
  const bend = joints.length === 3 ? object.field('bend') : object.optional('bend');
  return {
    ...{ name, joints, orient },
    tip: tip ? pointOf(tip) : [0, 0, 0],
    ...(bend && { bend: bendOf(bend) }),
    ...object.others(),
  };
}

function pointOf(value: JsonValue): LimbByName['tip'] {
  const [x, y, z, ...rest] = value.list().map((item) => item.number());
  return z === undefined || rest.length > 0 ? value.wrong('three numbers') : [x, y, z];
}

function bendOf(value: JsonValue): Bend {
  const object = value.object();
  return { dof: object.field('dof').text(), sign: object.field('sign').number(), ...object.others() };
}

function goalOf(value: JsonValue, report: Report): Goal {
  const object = value.object();
  const limb = object.field('limb').text();
  const space = object.optional('space');
  const own = object.field('channels').object();
  const channels = GOAL_CHANNELS.flatMap((name) => {
    const given = own.optional(name);
    return given ? [[name, readCurve(given, report) satisfies GoalCurve] as const] : [];
  });
  const { others: ofChannels } = own.others();
  return {
    ...{ limb, space: space ? spaceOf(space, report) : WORLD_SPACE },
    channels: Object.fromEntries(channels),
    ...(ofChannels && { ofChannels }),
    ...object.others(),
  };
}

function spaceOf(value: JsonValue, report: Report): Goal['space'] {
  if (value.isText()) return value.text();
  const spaces = value.list().map((row): SpaceKey => {
    const [time, name, ...rest] = row.list();
    return name === undefined || rest.length > 0 ? row.wrong('a time and a space') : [time.number(), name.text()];
  });
  if (spaces.length === 0) value.wrong('a space, or times with spaces');
  if (spaces.some(([time], k) => k > 0 && time < spaces[k - 1][0])) {
    report.warn('keys-unsorted', `${value.path} is out of order in time.`, WHOLE_FILE, 'sorted');
    spaces.sort(([a], [b]) => a - b);
  }
  return spaces;
}
