/** Acclaim files as they are opened, and a skeleton with something of everything. */

import type { ImportedFile } from '../../src/files/imports.ts';
import { formatOf } from '../../src/files/readers.ts';
import { writeFile } from '../../src/files/writers.ts';
import type { ContentOf, FileContent } from '../../src/model/files.ts';

const UTF8 = new TextEncoder();

/** A skeleton in radians, with every kind of DOF, a bone that lengthens, one outside the hierarchy's order, limits. */
export const ODD_ASF = `# a comment
:version 1.10
:name Oddity
:units
  mass 1.0
  length 0.45
  angle rad
:documentation
  begin and end are words here
:root
  order TX TY TZ RZ RX RY
  axis ZXY
  position 1 2.5 -0.5
  orientation 0.3 -0.5 0.9
:bonedata
  begin
    id 1
    name low
    direction 0 1 0
    length 0.75
    axis -1.1 -0.8 1.02 XYZ
    dof rx ry rz
    limits (-3.1 3.1)
           (-2 2)
           (-inf inf)
    bodymass 3.5
  end
  begin
    id 2
    name rod
    direction 1 0 0
    length 2
    axis 0.1 0.2 0.3 ZXY
    dof rx l
  end
  begin
    id 3
    name slide
    direction 0 0 1
    length 1.2
    axis 0.9 -0.6 -1.1 YZX
    dof tx ty tz rz rx
  end
  begin
    id 4
    name stick
    direction 0.6 0.8 0
    length 1
    axis 0 0 0 XYZ
  end
:hierarchy
  begin
    root low
    low rod stick
    rod slide
  end
`;

/** Two frames of it. */
export const ODD_AMC = `#!made
:FULLY-SPECIFIED
:RADIANS
:SAMPLES-PER-SECOND 60
1
root 0.4 -0.2 0.3 0.5 0.25 -0.75
low 0.1 0.2 0.3
rod 0.5 0.25
slide 0.1 0.2 0.3 -0.5 1
2
root 0.5 -0.25 0.3 0.75 0.125 -0.5
low 0.2 0.1 -0.3
rod -0.5 -0.125
slide 0.4 0.25 0.125 0.5 -1
`;

/** Reads a skeleton as it is opened. */
export async function readAsfText(text: string | Uint8Array, name = 'x.asf'): Promise<ImportedFile<ContentOf<'asf'>>> {
  const { value, ...rest } = await imported(name, text);
  return { ...rest, ...(value?.kind === 'asf' && { value }) };
}

/** Reads a motion as it is opened, with its skeleton beside it. */
export async function readAmcText(
  text: string | Uint8Array,
  skeleton: string | Uint8Array | undefined = ODD_ASF,
  [name, skeletonName] = ['x_walk.amc', 'x.asf'],
): Promise<ImportedFile<ContentOf<'amc'>>> {
  const { value, ...rest } = await imported(
    name,
    text,
    skeleton ? { name: skeletonName, bytes: bytesOf(skeleton) } : undefined,
  );
  return { ...rest, ...(value?.kind === 'amc' && { value }) };
}

async function imported(
  fileName: string,
  text: string | Uint8Array,
  near?: { readonly name: string; readonly bytes: Uint8Array<ArrayBuffer> },
): Promise<ImportedFile> {
  const read = await formatOf(fileName)?.imports?.({
    fileName,
    bytes: bytesOf(text),
    beside: async (path) =>
      near && path === near.name
        ? { bytes: near.bytes, source: { name: near.name, path: near.name, bytes: near.bytes.length } }
        : undefined,
    near: () => (near ? [near.name] : []),
  });
  if (!read) throw new Error(`${fileName} is not imported.`);
  return read;
}

function bytesOf(text: string | Uint8Array): Uint8Array<ArrayBuffer> {
  return typeof text === 'string' ? UTF8.encode(text) : new Uint8Array(text);
}

/** The text that content is written as. */
export function writtenText(content: FileContent, name: string): string {
  const result = writeFile(content, name);
  if (!result) throw new Error(`Nothing writes ${name}.`);
  if ('text' in result) return result.text;
  return Buffer.concat([...result.pieces]).toString();
}
