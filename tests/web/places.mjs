// Where the things that are compared lie.
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('../..', import.meta.url));
export const webBuild = `${root}build/web`;
export const site = `${webBuild}/site`;
export const nativePrograms = process.env.WELKIN_NATIVE ?? `${root}build/release/bin`;
export const pictures = `${webBuild}/test-pictures`;
