// Reads a recording with MCAP's official reader, once by its index and once as a stream, all CRCs checked, and prints as
// JSON what it found: node read_with_mcap_core.cjs NODE_MODULES FILE [cut]. With "cut" the file has no summary, and only
// the stream is read.
const fs = require("fs");
const path = require("path");
const { createRequire } = require("module");

const [modules, file, cut] = process.argv.slice(2);
const load = createRequire(path.join(path.resolve(modules), "x.js"));
const { McapIndexedReader, McapStreamReader } = load("@mcap/core");
const { loadDecompressHandlers } = load("@mcap/support");

const bytes = fs.readFileSync(file);
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
};

function describe(messages, channels, schemas) {
  const poses = [];
  const counts = {};
  for (const message of messages) {
    const channel = channels.get(message.channelId);
    counts[channel.topic] = (counts[channel.topic] ?? 0) + 1;
    const schema = schemas.get(channel.schemaId);
    if (channel.messageEncoding !== "json" || schema.encoding !== "jsonschema") throw new Error("not JSON");
    JSON.parse(Buffer.from(schema.data).toString());
    const content = JSON.parse(Buffer.from(message.data).toString());
    if (schema.name !== "foxglove.FrameTransforms") continue;
    for (const t of content.transforms)
      poses.push([Number(message.logTime), t.child_frame_id, t.translation.x, t.translation.y, t.rotation.z, t.rotation.w]);
  }
  return { counts, poses };
}

async function indexed(decompressHandlers) {
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const messages = [];
  for await (const message of reader.readMessages({ validateCrcs: true })) messages.push(message);
  const attachments = [];
  for await (const a of reader.readAttachments({ validateCrcs: true })) attachments.push([a.name, a.data.length]);
  const metadata = {};
  for await (const m of reader.readMetadata()) metadata[m.name] = Object.fromEntries(m.metadata);
  const s = reader.statistics;
  return {
    ...describe(messages, reader.channelsById, reader.schemasById),
    attachments,
    metadata,
    statistics: [s.messageCount, s.schemaCount, s.channelCount, s.attachmentCount, s.metadataCount, s.chunkCount].map(Number),
    end: Number(s.messageEndTime),
    library: reader.header.library,
  };
}

function streamed(decompressHandlers) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(new Uint8Array(bytes));
  const messages = [];
  const channels = new Map();
  const schemas = new Map();
  let attachments = 0;
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") schemas.set(record.id, record);
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type === "Message") messages.push(record);
    if (record.type === "Attachment") ++attachments;
  }
  return { ...describe(messages, channels, schemas), attachments, done: reader.done() };
}

(async () => {
  const handlers = await loadDecompressHandlers();
  const result = { stream: streamed(handlers) };
  if (!cut) result.index = await indexed(handlers);
  console.log(JSON.stringify(result));
})().catch((error) => {
  console.error(String(error));
  process.exit(1);
});
