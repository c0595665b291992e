/** `.fbx` from version 7.0 on, binary or text. */
import { type ReadResult, readBytes } from '../../formats/reader.ts';
import type { Scene } from '../scene.ts';
import { readFbxFile } from './records/read-file.ts';
import { sceneOf } from './to-scene.ts';

/** Reads all that a file holds, as a scene. */
export function readFbx(fileName: string, bytes: Uint8Array<ArrayBuffer>): ReadResult<Scene> {
  return readBytes(fileName, bytes, (own, report) => {
    const read = readFbxFile(own, report);
    const dot = fileName.lastIndexOf('.');
    return sceneOf(read.file, dot > 0 ? fileName.slice(0, dot) : fileName, read.report);
  });
}
