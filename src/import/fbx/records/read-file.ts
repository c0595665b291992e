/** The records of an FBX file of either form; says of other files what they are. */

import { NO_PLACE } from '../../../formats/places.ts';
import { ParseError, type Report } from '../../../formats/report.ts';
import { FbxReport } from '../failure.ts';
import { readAscii, textVersion } from './ascii.ts';
import { binaryVersion, isBinaryFbx, readBinary } from './binary.ts';
import type { FbxFile } from './record.ts';

/** Throws a `ParseError` after it has reported why the file can't be read. */
export function readFbxFile(bytes: Uint8Array<ArrayBuffer>, report: Report): { file: FbxFile; report: FbxReport } {
  const isBinary = isBinaryFbx(bytes);
  const version = isBinary ? binaryVersion(bytes) : textVersion(bytes);
  if (version === undefined) {
    const found = bytes.length === 0 ? 'an empty file' : 'neither a binary header nor the comment of a text file';
    return refuse(report, 'not-fbx', `Expected an FBX file, found ${found}.`);
  }
  if (version < 7000) {
    const name = `${Math.floor(version / 1000)}.${Math.floor((version % 1000) / 100)}`;
    const advice = 'Save it again as FBX 2011 or later, or convert it with Autodesk’s FBX Converter.';
    return refuse(report, 'old-version', `Expected FBX 7.0 or later, found version ${name}. ${advice}`);
  }
  const own = new FbxReport(report, bytes, !isBinary);
  const file = isBinary ? readBinary(bytes, own) : readAscii(bytes, own);
  if (file.records.some(({ name, values }) => /^(Encryption|Password)/.test(name) && values.length > 0)) {
    return refuse(report, 'encrypted', 'The file is password-protected. Save it again without a password.');
  }
  return { file, report: own };
}

function refuse(report: Report, code: string, message: string): never {
  report.error(code, message, NO_PLACE);
  throw new ParseError(message);
}
