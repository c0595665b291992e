/**
 * `NAME.sets.json`, our own format: selection sets and locked DOFs of the skeleton `NAME`, joints by name, or `#7` by
 * index.
 *
 *     { "sets": [ { "name": "arm", "color": "#4a90e2", "joints": ["upper_arm_l", "#7"] } ],
 *       "locked": [ { "joint": "shin_l", "dofs": ["ry", "rz"] } ] }
 */
import type { SetsByName } from '../../model/sets-by-name.ts';
import { type JsonValue, jsonReader } from '../json/read.ts';
import type { Reader } from '../reader.ts';

/** A reader of `.sets.json`. Either list may be absent, but not both. */
export function setsReader(fileName: string): Reader<SetsByName> {
  return jsonReader(fileName, 'sets-wrong', (file) => {
    const object = file.object();
    const [sets, locked] = [object.optional('sets'), object.optional('locked')];
    if (!sets && !locked) file.wrong('{ "sets": […], "locked": […] }');
    return { sets: sets?.list().map(setOf) ?? [], locked: locked?.list().map(lockedOf) ?? [], ...object.others() };
  });
}

function setOf(value: JsonValue): SetsByName['sets'][number] {
  const object = value.object();
  const name = object.field('name').text();
  const color = object.optional('color')?.text();
  const joints = textsOf(object.field('joints'));
  return { name, ...(color !== undefined && { color }), joints, ...object.others() };
}

function lockedOf(value: JsonValue): SetsByName['locked'][number] {
  const object = value.object();
  const joint = object.field('joint').text();
  return { joint, dofs: textsOf(object.field('dofs')), ...object.others() };
}

function textsOf(value: JsonValue): readonly string[] {
  return value.list().map((item) => item.text());
}
