def check_run(o,e,g,h,s):
    print(e); print(g); print(h["link"], h["probe_rows"], h["verdict"]); return []
