// Lets the page's modules import './three.js', which mocap view serves from Debian's libjs-three.

import {register} from 'node:module';

const THREE = 'file:///usr/share/javascript/three/three.module.js';

const hooks = `
  export function resolve(specifier, context, next) {
    if (specifier !== './three.js') return next(specifier, context);
    return {url: '${THREE}', format: 'module', shortCircuit: true};
  }`;

register(`data:text/javascript,${encodeURIComponent(hooks)}`);
