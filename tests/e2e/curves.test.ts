import { testAll } from '../helpers/check.ts';
import { CURVES } from './checks/curves.ts';

testAll(CURVES);
