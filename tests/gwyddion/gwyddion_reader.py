"""Reads files of heights by Gwyddion's own file modules, and takes its statistics. Needs the package gwyddion.

One channel of one file as JSON on standard output: size, spacing, missing points, heights, and the statistics of the map
after Gwyddion's plane was removed. Gwyddion runs in a process of its own, without a display.

    gwyddion_reader.py FILE
    gwyddion_reader.py --time FILE     processor seconds of reading, of these statistics, of the autocorrelation, of a Gaussian
"""
import ctypes
import json
import os
import sys
import time

# Icons need a display, which is not there.
os.environ["GWYDDION_DATADIR"] = "/nonexistent"


def library(name):
    return ctypes.CDLL(name, mode=ctypes.RTLD_GLOBAL)


def main(path, is_timed=False):
    core, process, draw = (library(f"libgwy{n}2.so.0") for n in ("ddion", "process", "draw"))
    library("libgwydgets2.so.0")
    module, app = library("libgwymodule2.so.0"), library("libgwyapp2.so.0")
    draw.gwy_draw_type_init()
    app.gwy_app_init_common.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
    app.gwy_app_init_common(None, b"file", None)

    class Failure(ctypes.Structure):
        _fields_ = [("domain", ctypes.c_uint32), ("code", ctypes.c_int), ("message", ctypes.c_char_p)]

    module.gwy_file_load.restype = ctypes.c_void_p
    module.gwy_file_load.argtypes = [ctypes.c_char_p, ctypes.c_int, ctypes.c_void_p]
    failure = ctypes.POINTER(Failure)()
    kNonInteractive = 1
    container = module.gwy_file_load(os.fsencode(path), kNonInteractive, ctypes.byref(failure))
    if not container:
        sys.exit(f"{path}: Gwyddion: " + (failure.contents.message.decode() if failure else "no reason"))

    glib = library("libglib-2.0.so.0")
    core.gwy_container_gis_object.argtypes = [ctypes.c_void_p, ctypes.c_uint32, ctypes.c_void_p]

    def stored(key):
        out = ctypes.c_void_p()
        core.gwy_container_gis_object(container, glib.g_quark_from_string(key), ctypes.byref(out))
        return out.value

    field, mask = stored(b"/0/data"), stored(b"/0/mask")
    if not field:
        sys.exit(f"{path}: Gwyddion finds no map in it")

    def call(name, result, *arguments):
        function = getattr(process, name)
        function.restype = result
        function.argtypes = [ctypes.c_void_p if a is None or isinstance(a, int) and a > 1 << 31 else
                             type(a) if isinstance(a, ctypes._SimpleCData) else
                             ctypes.c_double if isinstance(a, float) else
                             ctypes.c_int if isinstance(a, int) else ctypes.c_void_p for a in arguments]
        return function(*arguments)

    columns = call("gwy_data_field_get_xres", ctypes.c_int, field)
    rows = call("gwy_data_field_get_yres", ctypes.c_int, field)
    width_m = call("gwy_data_field_get_xreal", ctypes.c_double, field)
    height_m = call("gwy_data_field_get_yreal", ctypes.c_double, field)
    count = columns * rows

    seconds = {"read": time.process_time()}

    def values(of):
        data = call("gwy_data_field_get_data_const", ctypes.c_void_p, of)
        return list((ctypes.c_double * count).from_address(data))

    out = {"columns": columns, "rows": rows, "x_spacing_m": width_m / columns, "y_spacing_m": height_m / rows}
    if not is_timed:
        missing = [m > 0 for m in values(mask)] if mask else [False] * count
        out["missing"] = sum(missing)
        out["height_m"] = [None if gone else z for z, gone in zip(values(field), missing)]
    if rows > 1 and not mask:
        plane = [ctypes.c_double() for _ in range(3)]
        call("gwy_data_field_fit_plane", None, field, *[ctypes.byref(x) for x in plane])
        call("gwy_data_field_plane_level", None, field, *[x.value for x in plane])
        call("gwy_data_field_add", None, field, -call("gwy_data_field_get_avg", ctypes.c_double, field))
        stats = [ctypes.c_double() for _ in range(5)]
        call("gwy_data_field_get_stats", None, field, *[ctypes.byref(x) for x in stats])
        low, high = ctypes.c_double(), ctypes.c_double()
        call("gwy_data_field_get_min_max", None, field, ctypes.byref(low), ctypes.byref(high))
        area = call("gwy_data_field_get_surface_area", ctypes.c_double, field)
        out["roughness"] = {
            "Sa_m": stats[1].value, "Sq_m": stats[2].value, "Ssk": stats[3].value, "Sku": stats[4].value + 3.0,
            "Sp_m": high.value, "Sv_m": -low.value, "Sz_m": high.value - low.value,
            "Sdq": call("gwy_data_field_get_surface_slope", ctypes.c_double, field),
            "Sdr": area / (width_m * height_m) - 1.0,
        }
    if is_timed:
        seconds["statistics"] = time.process_time() - seconds["read"]
        for name, work in (("autocorrelation", lambda: call("gwy_data_field_2dacf", None, field,
                                                            call("gwy_data_field_new_alike", ctypes.c_void_p, field, 0))),
                           ("gaussian", lambda: call("gwy_data_field_filter_gaussian", None, field, 5.0))):
            begin = time.process_time()
            work()
            seconds[name] = time.process_time() - begin
        out["processor_s"] = seconds
    json.dump(out, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[-1], sys.argv[1] == "--time")
