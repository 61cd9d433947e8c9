#include "asperity_firmware/frame.h"

#include "asperity_firmware/crc32.h"

static void store(asp_frame_writer* writer, uint8_t byte) {
  if (writer->used < writer->capacity) {
    writer->out[writer->used] = byte;
    ++writer->used;
  } else {
    writer->overflow = true;
  }
}

static void open_block(asp_frame_writer* writer) {
  writer->code_at = writer->used;
  writer->block_open = true;
  store(writer, 0);
}

static void close_block(asp_frame_writer* writer) {
  writer->block_open = false;
  if (!writer->overflow) {
    writer->out[writer->code_at] = (uint8_t)(writer->used - writer->code_at);
  }
}

static void stuff(asp_frame_writer* writer, uint8_t byte) {
  if (!writer->block_open) {
    open_block(writer);
  }
  if (byte == 0) {
    close_block(writer);
    open_block(writer);
    return;
  }
  store(writer, byte);
  if (writer->used - writer->code_at == 255) {
    close_block(writer);
  }
}

void asp_frame_begin(asp_frame_writer* writer, uint8_t* out, size_t capacity) {
  writer->out = out;
  writer->capacity = capacity;
  writer->used = 0;
  writer->overflow = false;
  writer->crc = ASP_CRC32_START;
  open_block(writer);
}

void asp_frame_put_u8(asp_frame_writer* writer, uint8_t value) {
  writer->crc = asp_crc32_put(writer->crc, value);
  stuff(writer, value);
}

void asp_frame_put_u16(asp_frame_writer* writer, uint16_t value) {
  asp_frame_put_u8(writer, (uint8_t)(value & 0xFFu));
  asp_frame_put_u8(writer, (uint8_t)(value >> 8));
}

void asp_frame_put_u32(asp_frame_writer* writer, uint32_t value) {
  asp_frame_put_u16(writer, (uint16_t)(value & 0xFFFFu));
  asp_frame_put_u16(writer, (uint16_t)(value >> 16));
}

void asp_frame_put_u64(asp_frame_writer* writer, uint64_t value) {
  asp_frame_put_u32(writer, (uint32_t)(value & 0xFFFFFFFFu));
  asp_frame_put_u32(writer, (uint32_t)(value >> 32));
}

void asp_frame_put_bytes(asp_frame_writer* writer, const uint8_t* bytes, size_t count) {
  for (size_t i = 0; i < count; ++i) {
    asp_frame_put_u8(writer, bytes[i]);
  }
}

size_t asp_frame_end(asp_frame_writer* writer) {
  const uint32_t crc = asp_crc32_result(writer->crc);
  for (unsigned shift = 0; shift < 32; shift += 8) {
    stuff(writer, (uint8_t)((crc >> shift) & 0xFFu));
  }
  if (writer->block_open) {
    close_block(writer);
  }
  store(writer, 0);
  return writer->overflow ? 0 : writer->used;
}
