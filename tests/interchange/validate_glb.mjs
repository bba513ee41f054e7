// What Khronos' validator says of a GLB file.
//
// usage: node validate_glb.mjs MODULE FILE
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [module, path] = process.argv.slice(2);
const validator = createRequire(import.meta.url)(module);
const report = await validator.validateBytes(new Uint8Array(readFileSync(path)));
console.log(JSON.stringify(report.issues));
