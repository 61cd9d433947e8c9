"""What both ends counted, and whether it is what it must be."""
import csv

PERIOD_NS = 252100  # of the simulated sensor's rows (world.h)
FAULT_WORDS = [('imu_bus_failures', 'bus failure'), ('imu_overflows', 'overflow'), ('imu_lost_sync', 'out of step'),
               ('imu_invalid_rows', 'invalid row'), ('imu_restarts', 'restart'), ('force_bus_failures', 'bus failure'),
               ('force_skipped', 'skipped'), ('force_restarts', 'restart')]
NAMES = [name for name, _ in FAULT_WORDS]


def mixed(number):
    return number * 2654435761 & 0xFFFFFFFF


def signed16(value):
    return value - 65536 if value >= 32768 else value


def read_rows(path, failures):
    """The number of each row, and the forces. The number is in the first two values, and the next two are made of it."""
    rows = []
    forces = []
    with open(path) as file:
        for row in csv.DictReader(line for line in file if not line.startswith('#')):
            number = (int(row['accel_i']) & 0xFFFF) | (int(row['accel_j']) & 0xFFFF) << 16
            rest = (int(row['accel_k']), int(row['gyro_i']), int(row['gyro_j']), int(row['gyro_k']))
            right = (signed16(mixed(number) >> 16), signed16(mixed(number) & 0xFFFF), 0, -1)
            if rest != right and len(failures) < 5:
                failures.append('%s: row %d has other values than were sent: %s' % (path, number, rest))
            rows.append(number)
            if row['force']:
                forces.append(round(float(row['force'])) + 0x200000)
    return rows, forces


def gaps_of(rows):
    """Rows missing between neighbours."""
    return [number - before - 1 for before, number in zip(rows, rows[1:]) if number != before + 1]


class Checks:
    def __init__(self, failures):
        self.failures = failures

    def equal(self, what, value, expected):
        if value != expected:
            self.failures.append('%s is %s, not %s' % (what, value, expected))

    def holds(self, what, condition):
        if not condition:
            self.failures.append(what)


def check_clean(check, guest, host, rows, forces):
    for name in ['rows_dropped', 'rows_waiting', 'forces_dropped', 'imu_state', 'force_state'] + NAMES:
        check.equal('on the microcontroller ' + name, guest[name], 0)
    link = host['link']
    for name in ['lost_frames', 'lost_samples', 'damaged_frames', 'late_frames', 'resyncs', 'restarts', 'overruns']:
        check.equal('at the host ' + name, link[name], 0)
    check.equal('the report of faults', link['sensor_faults'], '')
    check.equal('rows stored', host['probe_rows'], guest['rows_numbered'])
    check.equal('rows that miss their predecessor', len(gaps_of(rows)), 0)
    check.equal('forces that miss their predecessor', sum(b != a + 1 for a, b in zip(forces, forces[1:])), 0)
    # The last conversions may wait for a row that never comes.
    check.holds('%d of %d forces stored' % (len(forces), guest['forces_sent']), guest['forces_sent'] - len(forces) <= 3)
    check.holds('%d of %d conversions sent' % (guest['forces_sent'], guest['conversions_made']),
                guest['conversions_made'] - guest['forces_sent'] <= 2)


def check_faults(check, guest, host, rows, log):
    link = host['link']
    check.equal('rows stored and lost', host['probe_rows'] + link['lost_samples'], guest['rows_numbered'])
    for name, word in FAULT_WORDS:
        check.holds('%s is not in the report: %s' % (name, link['sensor_faults']),
                    guest[name] > 0 and '%d %s' % (guest[name], word) in link['sensor_faults'] or
                    '%d ' % guest[name] in link['sensor_faults'] and word in link['sensor_faults'])
    check.holds('imu_lost_sync is %d' % guest['imu_lost_sync'], 1 <= guest['imu_lost_sync'] <= 3)  # a line that is stuck may begin in a read
    for name, expected in [('imu_invalid_rows', 5), ('imu_restarts', 5), ('force_restarts', 1),
                           ('imu_state', 0), ('force_state', 0)]:
        check.equal(name, guest[name], expected)
    check.equal('damaged frames', link['damaged_frames'], 3)
    check.equal('lost frames', link['lost_frames'], 3)
    missed = guest['force_skipped'] + guest['force_bus_failures'] + guest['forces_sent']
    check.holds('conversions made %d, accounted for %d' % (guest['conversions_made'], missed),
                0 <= guest['conversions_made'] - missed <= 2)
    check.equal('gaps', len(gaps_of(rows)), 10)
    # A sensor that is started again makes no rows meanwhile; what it would have made is counted by time.
    by_time = guest['rows_span_ns'] / PERIOD_NS + 1
    check.holds('rows numbered %d, by time %.1f' % (guest['rows_numbered'], by_time),
                abs(guest['rows_numbered'] - by_time) <= 5)
    check.holds('"not found" was not reported while it was so', 'inertial sensor: not found' in log)


def check_absent(check, guest, host, rows, log):
    check.holds('"not found" was not reported while it was so', 'inertial sensor: not found' in log)
    check.equal('imu_state at the end', guest['imu_state'], 0)
    check.holds('%d rows stored' % len(rows), len(rows) > 10000)
    check.equal('rows that miss their predecessor', len(gaps_of(rows)), 0)


def instructions(guest, shift):
    """Of the core and drivers a row, of the UART's loop a byte, and of the longest turn, without the models' and the measuring's."""
    per_tick = guest['tick_ps'] / 1000.0 / (1 << shift)
    own = guest['measure_own_q6'] / 64.0
    outer = guest['measure_outer_q6'] / 64.0
    inner = guest['bus_count'] + guest['link_count']
    core = guest['step_ticks'] - guest['bus_ticks'] - guest['link_ticks'] - inner * (outer - own) - guest['step_count'] * own
    rows = guest['rows_numbered'] - guest['rows_dropped']
    return {'instructions_a_row': core * per_tick / rows,
            'uart_instructions_a_byte': (guest['link_ticks'] - guest['link_count'] * own) * per_tick / guest['bytes'],
            'longest_turn_instructions': guest['step_longest_own'] * per_tick}


def check_run(options, ends, guest, host, shift):
    """Prints the figures; returns what failed."""
    failures = []
    check = Checks(failures)
    check.equal("qemu's exit code", ends['qemu_exit'], 0)
    check.equal('bytes bridged', ends['bridged_bytes'], guest['bytes'])
    rows, forces = read_rows(options.out + '/recording/probe.csv', failures)
    log = open(options.out + '/record.log').read()
    if options.scenario == 'clean':
        check_clean(check, guest, host, rows, forces)
    elif options.scenario == 'faults':
        check_faults(check, guest, host, rows, log)
    else:
        check_absent(check, guest, host, rows, log)
    cost = instructions(guest, shift)
    print('%s, %s: %d s in %.0f s; %d rows numbered, %d stored, %d lost; %d conversions, %d sent, %d stored; %d bytes' %
          (options.machine, options.scenario, options.seconds, ends['elapsed_s'], guest['rows_numbered'],
           host['probe_rows'], host['link']['lost_samples'], guest['conversions_made'], guest['forces_sent'], len(forces),
           guest['bytes']))
    if host['link']['sensor_faults']:
        print('  reported: ' + host['link']['sensor_faults'])
    print('  state of core %d and drivers %d bytes; stack %d of %d bytes; core and drivers %.0f instructions a row, longest turn %d; UART %.0f a byte' %
          (guest['probe_state'], guest['sensors_state'], guest['stack_used'], guest['stack_size'], cost['instructions_a_row'], cost['longest_turn_instructions'],
           cost['uart_instructions_a_byte']))
    return failures
