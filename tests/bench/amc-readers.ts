/** What the benchmark of Acclaim's motions measures, in one bundle, as it ships. */
export { readAmc } from '../../src/formats/acclaim/read-amc.ts';
export { readBvh } from '../../src/formats/bvh/read.ts';
export { Report } from '../../src/formats/report.ts';
