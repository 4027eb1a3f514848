// Prints the JSON schemas that Foxglove publishes, by their titles: node print_foxglove_schemas.cjs NODE_MODULES NAME...
const path = require("path");
const { createRequire } = require("module");

const [modules, ...names] = process.argv.slice(2);
const published = createRequire(path.join(path.resolve(modules), "x.js"))("@foxglove/schemas/jsonschema");
console.log(JSON.stringify(Object.fromEntries(names.map((name) => ["foxglove." + name, published[name]]))));
