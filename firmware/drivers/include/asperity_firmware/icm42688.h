#ifndef ASPERITY_FIRMWARE_ICM42688_H
#define ASPERITY_FIRMWARE_ICM42688_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "asperity_firmware/board.h"
#include "asperity_firmware/clock.h"
#include "asperity_firmware/spi.h"

#ifdef __cplusplus
extern "C" {
#endif

// TDK ICM-42688-P (datasheet DS-000347): accelerometer ±16 g and gyroscope ±2000 °/s at 4 kHz through its FIFO, SPI
// mode 0 or 3, up to 24 MHz. Anti-alias filters of both at 997 Hz, so that both have the same delay. INT1: a pulse of 8
// µs for each row while the FIFO has the watermark's rows or more.
#define ASP_ICM42688_PERIOD_NS 250000u
#define ASP_ICM42688_WATERMARK 16u   // rows, and so the rows of one read
#define ASP_ICM42688_FIFO_ROWS 128u  // 2048 bytes of 16
#define ASP_ICM42688_COUNTS_PER_G 2048.0
#define ASP_ICM42688_COUNTS_PER_DEG_PER_S 16.384

typedef enum {
  ASP_ICM42688_OK,
  ASP_ICM42688_BUS_FAILED,
  ASP_ICM42688_NOT_FOUND,      // WHO_AM_I is another
  ASP_ICM42688_NO_RESET,       // it does not say that it has reset itself
  ASP_ICM42688_NOT_AS_WRITTEN  // a register reads back otherwise
} asp_icm42688_status;

// A FIFO packet: header, accelerometer, gyroscope (16 bits each, big-endian), temperature, time stamp; 16 bytes, or 20
// with four more bits of each value, which are the lowest and are left away here.
typedef enum {
  ASP_PACKET_ROW,
  ASP_PACKET_INVALID,  // a sensor had no valid value: all three are −32768
  ASP_PACKET_EMPTY,    // the FIFO had none
  ASP_PACKET_STRANGE   // not the header of such a packet: the FIFO's bytes are out of step
} asp_packet_kind;

#define ASP_PACKET_BYTES 16u
#define ASP_PACKET_HIRES_BYTES 20u

// Reads a packet of ASP_PACKET_BYTES, or of ASP_PACKET_HIRES_BYTES where `hires`. Fills accel and gyro of `row`.
asp_packet_kind asp_icm42688_parse(const uint8_t* packet, bool hires, asp_imu_row* row);

typedef struct {
  uint32_t bus_failures;
  uint32_t overflows;  // the FIFO was full
  uint32_t lost_sync;  // a packet was strange
  uint32_t invalid_rows;
  uint32_t coasted_reads;  // rows whose time no interrupt confirmed
} asp_icm42688_statistics;

typedef struct {
  const asp_spi* spi;
  asp_edge edge;  // INT1's interrupt calls asp_edge_fire(&device.edge, now)
  asp_row_clock clock;
  bool found_row;      // a row has been given
  bool recovering;     // the FIFO was thrown away: how many rows that were is not known yet
  uint32_t lost_rows;  // before the next row
  asp_icm42688_statistics statistics;
} asp_icm42688;

// Resets and configures the sensor, reads every register back and starts it. Takes some 60 ms.
asp_icm42688_status asp_icm42688_start(asp_icm42688* device, const asp_spi* spi);

// After asp_icm42688_start() of a sensor that had worked: takes the clock over from `before`, so that the rows lost
// since are counted by time, and leaves the statistics at zero.
void asp_icm42688_continue(asp_icm42688* device, const asp_icm42688* before);

// For asp_board.read_imu: once the FIFO has ASP_ICM42688_WATERMARK rows, gives so many (fewer where some are invalid),
// else none. `capacity` must be so much at least. A full FIFO, bytes out of step or a failed bus: the FIFO is emptied,
// and the rows lost are counted by the time until the next.
size_t asp_icm42688_read(asp_icm42688* device, asp_imu_row* rows, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
