/** Generates every example and its files, reproducibly to the byte. */
import { writeAnim } from '../../src/formats/anim/write.ts';
import { writeMorph } from '../../src/formats/morph/write.ts';
import { writeRig } from '../../src/formats/rig/write.ts';
import { writeSkel } from '../../src/formats/skel/write.ts';
import { writeSkin } from '../../src/formats/skin/write.ts';
import { crawlerSample } from './crawler/crawler.ts';
import type { Sample } from './example.ts';
import { jointsSample } from './joints/joints.ts';
import { cubeSample } from './lessons/cube.ts';
import { tangentsSample } from './lessons/tangents.ts';
import { walkerSample } from './walker/walker.ts';

/** An entry of `samples.json`, which the page's menu reads. */
export interface SampleListing {
  readonly id: string;
  readonly label: string;
  readonly description: string;
  /** Names in the same folder; opened together they are bound by the rig. */
  readonly files: readonly string[];
  readonly shows?: Sample['shows'];
}

let made: readonly Sample[] | undefined;

/** The default one first; made once. */
export function makeSamples(): readonly Sample[] {
  made ??= [walkerSample(), crawlerSample(), jointsSample(), tangentsSample(), cubeSample()];
  return made;
}

/** An example's files by name, the rig first. */
export function sampleFiles(sample: Sample): Map<string, string | Uint8Array> {
  const { id, skeleton, skin, morphs, take, rig, textures } = sample;
  const files = new Map<string, string | Uint8Array>([[`${id}.rig`, writeRig(rig).text]]);
  files.set(`${skeleton.name}.skel`, writeSkel([skeleton]).text);
  if (skin) files.set(`${skin.name}.skin`, writeSkin(skin).text);
  for (const morph of morphs) files.set(`${morph.name}.morph`, writeMorph(morph).text);
  files.set(`${take.name}.anim`, writeAnim(take).text);
  for (const { name, bytes } of textures) files.set(name, bytes);
  return files;
}

/** All files of the examples' folder by name, `samples.json` first. */
export function sampleFolder(): Map<string, string | Uint8Array> {
  const entries: SampleListing[] = [];
  const files = new Map<string, string | Uint8Array>();
  for (const sample of makeSamples()) {
    const own = sampleFiles(sample);
    const { id, label, description, shows } = sample;
    entries.push({ id, label, description, files: [...own.keys()], ...(shows && { shows }) });
    for (const [name, content] of own) files.set(name, content);
  }
  return new Map<string, string | Uint8Array>([['samples.json', `${JSON.stringify(entries, null, 2)}\n`], ...files]);
}
