/**
 * `NAME.layers.json`, our own format: the layers of the take `NAME`, from the lowest up, each an `.anim` with the base's
 * channels.
 *
 *     { "base": "walk.base.anim", "flattened": { "file": "walk.anim", "sha256": "64 hex digits" },
 *       "layers": [ { "name": "arm", "file": "walk.arm.anim", "mode": "additive", "weight": 0.5,
 *                     "mute": false, "solo": false, "joints": ["upper_arm_l", "#7"], "root": false, "morphs": false } ] }
 */

import { LAYER_MODES } from '../../model/takes/layers.ts';
import type { LayerRow, LayersFile } from '../../model/takes/layers-file.ts';
import { type JsonCurve, readCurve } from '../json/curve.ts';
import { readFlattened } from '../json/flattened.ts';
import { type JsonValue, jsonReader } from '../json/read.ts';
import { WHOLE_FILE } from '../places.ts';
import type { Reader } from '../reader.ts';
import type { Report } from '../report.ts';

/** A reader of `.layers.json`. */
export function layersReader(fileName: string): Reader<LayersFile> {
  return jsonReader(fileName, 'layers-wrong', (file, report) => {
    const object = file.object();
    const base = object.field('base').text();
    const flattened = object.optional('flattened');
    const rows = object.field('layers').list();
    const layers = rows.map((row) => layerOf(row, report));
    const names = layers.map(({ name }) => name.toLowerCase());
    const twice = names.findIndex((name, i) => names.indexOf(name) < i);
    if (twice >= 0) rows[twice].object().field('name').wrong('a name that no other layer has');
    return { base, ...(flattened && { flattened: readFlattened(flattened) }), layers, ...object.others() };
  });
}

function layerOf(value: JsonValue, report: Report): LayerRow {
  const object = value.object();
  const [given, joints] = [object.optional('weight'), object.optional('joints')];
  const weight: JsonCurve = given ? readCurve(given, report) : { curve: 1 };
  const row = {
    name: object.field('name').text(),
    file: object.field('file').text(),
    mode: object.field('mode').word(LAYER_MODES),
    weight: weight.curve,
    ...(weight.others && { ofWeight: weight.others }),
    mute: object.optional('mute')?.boolean() ?? false,
    solo: object.optional('solo')?.boolean() ?? false,
    ...(joints && { joints: joints.list().map((joint) => joint.text()) }),
    root: object.optional('root')?.boolean() ?? false,
    morphs: object.optional('morphs')?.boolean() ?? false,
  };
  if (typeof row.weight === 'number' && !(row.weight >= 0 && row.weight <= 1)) {
    const message = `${value.path}.weight: expected a weight from 0 to 1, found ${row.weight}.`;
    report.warn('layer-weight', message, WHOLE_FILE, `used ${row.weight > 1 ? 1 : 0}`);
  }
  return { ...row, ...object.others() };
}
