/**
 * `NAME.attach.json`, our own format: what the root follows in the take `NAME`, in spans of its seconds.
 *
 *     { "base": "sword_cut.base.anim", "flattened": { "file": "sword_cut.anim", "sha256": "64 hex digits" },
 *       "attached": [ { "character": "walker", "joint": "hand_r", "span": [0.5, 2],
 *                       "offset": { "position": [0, 0.1, 0], "rotation": [0, 0, 1.57] } } ] }
 */
import type { Vec3 } from '../../math/vec3.ts';
import type { AttachFile, AttachmentRow } from '../../model/takes/attach-file.ts';
import { readFlattened } from '../json/flattened.ts';
import { type JsonValue, jsonReader } from '../json/read.ts';
import type { Reader } from '../reader.ts';

/** A reader of `.attach.json`. */
export function attachReader(fileName: string): Reader<AttachFile> {
  return jsonReader(fileName, 'attach-wrong', (file) => {
    const object = file.object();
    const base = object.field('base').text();
    const flattened = object.optional('flattened');
    const attached = object.field('attached').list().map(rowOf);
    return { base, ...(flattened && { flattened: readFlattened(flattened) }), attached, ...object.others() };
  });
}

function rowOf(value: JsonValue): AttachmentRow {
  const object = value.object();
  const [character, joint] = [object.field('character').text(), object.field('joint').text()];
  const span = object.field('span');
  const [start, end, ...more] = span.list().map((time) => time.number());
  const offset = object.field('offset').object();
  const [position, rotation] = [vector(offset.field('position')), vector(offset.field('rotation'))];
  return {
    ...{ character, joint },
    span: start < end && more.length === 0 ? [start, end] : span.wrong('two times, the first before the second'),
    offset: { position, rotation, ...offset.others() },
    ...object.others(),
  };
}

function vector(value: JsonValue): Vec3 {
  const [x, y, z, ...more] = value.list().map((item) => item.number());
  return z === undefined || more.length > 0 ? value.wrong('three numbers') : [x, y, z];
}
