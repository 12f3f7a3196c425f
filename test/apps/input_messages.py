# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of the messages about input: command lines, and files of points and tracks."""
from message_case import (DENIED, NO_FILE, ONE_FLIP, case, checkpoint, points, simulate, tracks,
                          walkable)

FORMATS = "auto, rows, frames, ids, table, jupedsim, sumo, lammps, xyz, geojson, gpx or trackmate"
VIEWER_WORDS = ("t, event, show, hide, edge, point, follow, color, at, kinds, unit, legend, play, theme, list, "
                "draw")
COMMANDS = "generate, simulate, resume, tracks, wave, experiment, render, live, completion, manual or help"
SCENARIOS = "uniform, gaussian, constant-speed, one-mover, lattice, lattice-jitter or packing"
POINTS_COLUMNS = "x,y,vx,vy and optionally radius, growth, mass, ax,ay, jx,jy, in any order"
TRACKS_COLUMNS = ("t,id,x,y and optionally radius, in any order, or --columns t=NAME,id=NAME,x=NAME,y=NAME "
                  "for the names in another table, --columns t=N,id=N,x=N,y=N for the numbers of the columns, from 1 on, of one "
                  "without a header, or a file in one of the formats that --format lists")


def usage_cases():
    yield case("", commands=COMMANDS)
    yield case("stimulate", word="stimulate", name="simulate")
    yield case("arrange", word="arrange", commands=COMMANDS)
    yield case("help arrange", word="arrange", commands=COMMANDS)
    yield case("generate uniform --point 5", word="--point", name="--points")
    yield simulate("--evnets e.csv", word="--evnets", name="--events")
    yield case("--wrong", word="--wrong", commands=COMMANDS)
    yield case("--quiet simulate p.csv --until 1", word="--quiet")
    yield case("--points 5 generate uniform --points 5", word="--points")
    yield case("generate --points 5 uniform --points 5", word="--points")
    yield case("generate", commands=SCENARIOS)
    yield case("generate spiral", word="spiral", commands=SCENARIOS)
    yield simulate("--wrong", word="--wrong")
    yield simulate("q.csv", word="q.csv")
    yield case("resume p.csv --until 3 --box 0,0,1,1", word="--box")
    yield case("generate uniform --points 5 --spacing 1", word="--spacing")
    yield case("simulate p.csv")
    yield case("resume p.csv")
    yield case("generate uniform", option="--points", value="N")
    for command, argument in (("simulate", "POINTS"), ("resume", "CHECKPOINT"), ("tracks", "TRACKS")):
        yield case(command, argument=argument)
    yield case("completion", argument="SHELL", choices="bash|zsh|fish")
    yield case("completion tcsh", option="SHELL", text="tcsh", choices="bash, zsh or fish")
    yield case("manual page", word="page")
    yield case("simulate p.csv --until", option="--until")
    yield case("simulate p.csv --until=", option="--until")
    yield simulate("--fps", option="--fps")
    yield simulate("--until 2", option="--until")
    yield simulate("--fps 1 --frames-per-time 2", option="--fps")
    yield simulate("--quiet=perhaps", flag="--quiet", value="perhaps")
    yield case("experiment --output r --events e", option="--events", other="--single")
    yield case("experiment --seed 3", option="--seed", other="--single")
    yield case("experiment --single 50 --output r", option="--output", other="--single")


def number_cases():
    """Values of options."""
    for text in ("soon", "", "1,5", "--1"):
        yield case(f"simulate p.csv --until '{text}'" if text else "generate uniform --points 1 --side ''",
                   option="--until" if text else "--side", text=text)
    for text in ("inf", "-nan"):
        yield case(f"simulate p.csv --until {text}", option="--until", text=text)
    yield case("simulate p.csv --until 1e999", option="--until", text="1e999")
    yield simulate("--from nan", option="--from", text="nan")
    yield simulate("--box 0,0,1,inf", option="--box", text="inf")
    yield simulate("--frames f --fps many", option="--fps,--frames-per-time", text="many")
    yield case("wave --until x", option="--until", text="x")
    yield simulate("--collisions log --radius -0.5", option="--radius", number=-0.5)
    yield simulate("--frames f --fps 0", option="--fps,--frames-per-time", number=0)
    yield case("tracks t.csv --max-gap 0", option="--max-gap", number=0)
    yield case("wave --speed 0", option="--speed", number=0, lowest=1e-100, highest=1e100)
    yield case("generate lattice --points 5 --speed 0.5", option="--speed", number=0.5, lowest=1,
               highest=9007199254740992)
    yield case("generate uniform --points 5 --speed -1", option="--speed", number=-1, lowest=1e-100,
               highest=1e100)
    for text in ("-1", "many", "", "1.5", "1e3", "100000001", "9" * 23, "0x10", " 5"):
        yield case(f"generate uniform --points '{text}'", option="--points", text=text,
                   highest=100000000)
    yield case("generate uniform --points 5 --seed -1", option="--seed", text="-1",
               highest=18446744073709551615)
    yield case("experiment --single 101", option="--single", text="101", highest=100)
    for option, word, choices in (("--audit", "all", "none, end or events"),
                                  ("--progress", "loud", "auto, always or never"),
                                  ("--coincident", "keep", "hide or refuse"),
                                  ("--collisions", "bump", "none, log, swap, elastic, stop or remove")):
        yield simulate(f"{option} {word}", option=option, text=word, choices=choices)
    yield case("tracks t.csv --format xml", option="--format", text="xml", choices=FORMATS)
    yield case("experiment --output r --collisions none", option="--collisions", text="none",
               choices="log, swap, elastic, stop or remove")
    yield case("generate lattice --points 5 --movers two", option="--movers", text="two",
               choices="none, one, columns or all")


def periodic_cases():
    """Of --periodic and --shear."""
    for text, n in (("4", 1), ("4,5,6,7", 4), ("4,5,6,", 4)):
        yield simulate(f"--periodic {text}", text=text, n=n)
    yield simulate("--periodic 4,x", option="--periodic", text="x")
    yield simulate("--periodic 4,inf", option="--periodic", text="inf")
    yield simulate("--periodic 4,5 --shear nan", option="--shear", text="nan")
    for text in ("0,5", "-4,-5", "4,0,1"):
        yield simulate(f"--periodic={text}", text=text)
    yield simulate("--shear 0.5")
    yield simulate("--periodic 1,1e300 --shear 1e10", rate="1e10", height="1e+300")
    yield simulate("--periodic 1,1e-300 --shear 1e-100", rate="1e-100", height="1e-300")
    for option in ("--box 0,0,9,9", "--rim", "--walkable w --areas n", "--walkable w --mean-areas n"):
        yield simulate(f"--periodic 9,9 {option}", option=option.split()[0])
    yield case("simulate p.csv --until-share 0.5 --periodic 9,9", option="--until-share")
    box = "--until 1 --periodic 4,4,1 --shear 0.5"
    yield points("x,y,vx,vy,ax,ay\n0,0,0,0,1,0\n", box)
    yield points("x,y,vx,vy\n0,0,0,0\n6,8,4,0\n", box + " --coincident refuse", line=3, first=2)
    yield points("x,y,vx,vy\n0,0,0,0\n1e10,0,0,0\n", box, id=1)
    yield simulate("--periodic 9,1e150 --areas n", option="--areas", length="1e+150")
    yield simulate("--periodic 9,1e9 --shear 1e141 --mean-areas m", option="--mean-areas", length="1e+150")
    yield simulate("--periodic 9,9 --encounters n --range 1e8", distance="1e+08", length=9)
    yield simulate("--periodic 9,9 --regular --encounters n --range 1e300", distance="1.0000000000000038e+300", length=9,
                   files={"p.csv": "x,y,vx,vy,radius\n0,0,0,0,1\n2,2,0,0,0.5\n"})
    yield simulate("--pressure p")
    yield simulate("--thermostat 1,2,3", text="1,2,3", n=3)
    yield simulate("--thermostat=-1", text="-1", number=-1)
    yield simulate("--thermostat 1,0", text="1,0", number=0)
    yield simulate("--thermostat 2e6", rate="2000000", most=1000000)
    yield simulate("--thermostat 1", energy=0, files={"p.csv": "x,y,vx,vy\n0,0,0,0\n"})
    yield simulate("--thermostat 1,2", energy="inf", files={"p.csv": "x,y,vx,vy\n0,0,1e200,0\n"})
    yield simulate("--periodic 9,9 --radius 1")
    yield simulate("--periodic 9,9 --collisions log", option="--collisions", file="p.csv")
    collide = box + " --collisions elastic"
    yield points("x,y,vx,vy\n0,0,0,0\n6,8,4,0\n", collide + " --radius 1", line=3, first=2)
    yield points("x,y,vx,vy\n0,0,0,0\n", collide + " --radius 2.125", line=2, id=0, x=1, y=0, time=0)
    yield points("x,y,vx,vy,radius\n0,0,0,0,0.5\n2,2,0,0,2.125\n", collide, line=3, id=1, x=1, y=0, time=0)
    yield case("simulate p.csv --until 2 --periodic 1,1", time="0.6465", a=0, b=1, x=2147483648, y=1,
               files={"p.csv": "x,y,vx,vy\n0,0,0,0\n2147483000.5,0.25,1000,0\n"})


def meaning_cases():
    """Options that do not go together."""
    yield simulate("--from 1.5", until=1, **{"from": 1.5}, what="--from")
    yield case("simulate p.csv --until -1", until=-1, **{"from": 0}, what="--from")
    yield case("tracks t.csv --until -1", until=-1, **{"from": 0}, what="the first observation")
    yield case("resume c --until 1.5", files={"c": checkpoint()}, until=1.5, file="c", time=2)
    yield simulate("--box 0,0,1", text="0,0,1", n=3)
    yield simulate("--box 0,0,1,2,3", text="0,0,1,2,3", n=5)
    yield simulate("--box 0,0,1,2,", text="0,0,1,2,", n=5)
    yield simulate("--box 5,0,5,9", text="5,0,5,9")
    yield simulate("--rim")
    yield from periodic_cases()
    yield simulate("--radius 1")
    yield simulate("--growth 1")
    growing = "--box -5,-5,5,5 --collisions elastic --growth 1"
    yield case(f"simulate p.csv --until-share 0.5 --until 2 --rim {growing}", option="--until",
               other="--until-share")
    yield case(f"simulate p.csv --until-share 1.5 --rim {growing}", option="--until-share", number=1.5,
               lowest=1e-09, highest=1)
    for options in ("", growing, "--rim --box -9,-9,9,9 --collisions elastic --radius 1",
                    "--rim --box -9,-9,9,9 --collisions log --growth 1"):
        yield case(f"simulate p.csv --until-share 0.5 {options}")
    yield case("resume c --until-share 0.5", files={"c": checkpoint()})
    yield simulate("--mass area")
    yield simulate("--mass area --collisions swap --radius 1")
    yield simulate("--mass weight", option="--mass", text="weight", choices="column or area")
    yield simulate("--collisions log --radius 1e308", radius="1e308")
    yield case("tracks t.csv --radius 1")
    yield case("simulate d.csv --until 1 --collisions log --radius 1", file="d.csv")
    yield case("simulate g.csv --until 1 --collisions log --growth 1", file="g.csv",
               files={"g.csv": "x,y,vx,vy,growth\n0,0,0,0,1\n"})
    for option in ("--collisions swap", "--rim --box -5,-5,5,5", "--regular"):
        yield simulate(option, option=option.split()[0], file="p.csv")
    yield case("tracks t.csv --collisions log", option="--collisions", file="t.csv")
    discs = "t,id,x,y,radius\n0,a,0,0,1\n1,a,1,0,1\n"
    yield case("tracks r.csv --collisions log --radius 1", files={"r.csv": discs}, file="r.csv")
    yield case("tracks t.csv --fps 25", file="t.csv")
    yield case("tracks t.csv --columns t=t,name,x=x", piece="name")
    yield case("tracks t.csv --columns t=t,t=u", column="t")
    yield case("tracks t.csv --columns ''")
    yield case("tracks t.csv --date-format %m", format="%m")
    yield case("tracks t.csv --unwrap nearest", file="t.csv", option="--unwrap")
    yield case("tracks t.csv --periodic", file="t.csv", option="--periodic")
    for option in ("--unwrap nearest", "--walkable w --areas n"):
        yield case(f"tracks t.csv --periodic {option}", option=option.split()[0])
    yield case("tracks t.csv --format rows --columns t=t,id=id,x=x,y=y", file="t.csv", format="rows")
    both, outputs = "--fps,--frames-per-time", "--frames, --vtu, --areas or --pressure"
    yield simulate("--fps 5", option=both, outputs=outputs)
    yield simulate("--frames-per-time 5", option=both, outputs=outputs)
    yield case("tracks t.csv --frames-per-time 5", option="--frames-per-time", outputs="--frames, --vtu or --areas")
    yield case("resume c --until 1 --fps 5", option=both, outputs=outputs, files={"c": checkpoint()})
    yield case("wave --fps 5", option=both, outputs="--frames or --vtu")
    yield simulate("--frames f --fps 1e9", option="--fps,--frames-per-time", rate="1000000000",
                   **{"from": 0}, until=1, most=1000000)
    nowhere = {"PATH": "/nowhere"}
    yield simulate("--plot plot.svg", environment=nowhere, otherwise="no --plot")
    yield case("experiment --output r", environment=nowhere, otherwise="--no-plots")
    yield case("tracks t.csv --closest 0")
    for option in ("--components", "--encounters", "--contact-plan"):
        yield simulate(f"{option} a", option=option)
    yield simulate("--connected a --between 0,1", option="--connected")
    yield simulate("--range 1")
    yield simulate("--encounters a --range -1", range=-1)
    yield simulate("--connected a --range 1")
    yield simulate("--between 0,1")
    yield simulate("--connected a --range 1 --between 7", names="7")
    yield simulate("--connected a --range 1 --between 1,2,3", names="1,2,3")
    yield simulate("--connected a --range 1 --between 1,", names="1,")
    yield simulate("--connected a --range 1 --between 0,4", name=4, file="p.csv")
    yield simulate("--connected a --range 1 --between 1,01", first="1", second="01")
    yield case("tracks t.csv --connected a --range 1 --between a,b", name="b", file="t.csv",
               files={"t.csv": "t,id,x,y\n0,a,0,0\n1,a,0,0\n1,b,9,9\n"})
    yield simulate("--connected a --range 1 --between '\"0,1'", text='"0,1')
    for option in ("--components a", "--connected a --between 0,1"):
        yield simulate(f"--collisions log --radius 0.1 --range 1 {option}", option=option.split()[0])
    yield simulate("--ridge 1")
    yield simulate("--html-view t=1")
    yield simulate("--html v.html --html-view 't=1&color'", option="--html-view", word="color")
    yield simulate("--html v.html --html-view theme=blue", option="--html-view", word="theme", value="blue",
                   what="light or dark")
    yield simulate("--html v.html --html-view colour=area", option="--html-view", text="colour",
                   choices=VIEWER_WORDS)
    yield simulate("--neighbors n.csv --ridge 0", option="--ridge", number=0)
    yield case("simulate s.csv --until 1 --collisions log --nearest n.csv",
               files={"s.csv": "x,y,vx,vy,radius\n0,0,0,0,1\n9,0,0,0,2\n"})
    yield case("experiment --output r --points 0")
    yield case("experiment --output r --seeds 0")
    yield case("experiment")
    yield case("wave --columns 0", option="--columns")
    yield case("wave --rows 0", option="--rows")
    yield case("wave --rows 1000000 --columns 2", columns=2, rows=1000000, most=1000000)
    yield case("wave --radius 5", radius=5, half=5)
    yield case("wave --radius 1 --sizes 5", radius=5, half=5)
    yield case("wave --jitter 5", jitter=5, room=4.921875)
    yield case("experiment --output r --sizes 16", small=0.5, large=8, share=1.01)
    yield simulate("--edges p.csv", option="--edges", path="p.csv")
    yield case("resume c --until 3 --checkpoint c", files={"c": checkpoint()}, option="--checkpoint",
               path="c")
    yield simulate("--edges old.csv --events ./old.csv", option="--events", other="--edges",
                   path="old.csv")
    yield simulate("--edges - --stats -", option="--edges", other="--stats", path="-")
    yield case("tracks t.csv --closest 1 --edges -", option="--edges", other="--closest", path="-")
    yield simulate("--frames f --edges f/edges.csv", option="--edges", path="f/edges.csv",
                   other="--frames", directory="f", prepare=lambda d: (d / "f").mkdir())
    yield simulate("--frames ./f/ --vtu f", option="--vtu", path="f", other="--frames",
                   directory="./f/")
    yield simulate("--frames f --vtu f/v", option="--vtu", path="f/v", other="--frames", directory="f",
                   prepare=lambda d: (d / "f").mkdir())
    yield simulate("--frames f --edges f", option="--edges", path="f", other="--frames", directory="f")
    yield case("wave --html x --events x", option="--events", other="--html", path="x")


def table_cases():
    """Files of points and tracks."""
    for content, command in (("points", "simulate {} --until 1"), ("tracks", "tracks {}"),
                             ("a simulation's state", "resume {} --until 1")):
        yield case(command.format("."), file=".", content=content)
        yield case(command.format("missing"), file="missing", content=content, reason=NO_FILE)
        yield case(command.format("old.csv"), file="old.csv", content=content, reason=DENIED,
                   unprivileged=True, prepare=lambda d: (d / "old.csv").chmod(0))
    for content, command in (("points", "simulate"), ("tracks", "tracks")):
        yield case(f"{command} /proc/self/mem" + (" --until 1" if command == "simulate" else ""),
                   file="/proc/self/mem", line=1, content=content)
    yield points("", columns=POINTS_COLUMNS)
    yield points("# x,y,vx,vy\n\n", columns=POINTS_COLUMNS)
    yield case("simulate - --until 1", file="standard input", columns=POINTS_COLUMNS)
    yield tracks("", columns=TRACKS_COLUMNS)
    yield points("x,y,vx,vy\n" + "1" * (1 << 20) + ",2,3,4\n", line=2, row="point")
    yield tracks("t,id,x,y\n" + "1" * (1 << 20) + ",2,3,4\n", line=2, row="observation")
    yield tracks("t,id,x,y,w\n", line=1, column="w", columns=TRACKS_COLUMNS)
    yield tracks("t;id;x;y\n", line=1, column="t;id;x;y", columns=TRACKS_COLUMNS)
    yield points("x,y,vx,vy,id\n1,2,3,4,\n", line=2, column="id")
    yield points("x,y,vx,vy,id\n1,2,3,4,a\n2,2,3,4,a\n", line=3, id="a", first=2)
    yield points('x,y,vx,vy\n"1,2,3,4\n', line=2, text='"1,2,3,4')
    yield points('x,y,vx,vy\n"1"2,2,3,4\n', line=2, text="2", separator=",")
    yield points("x;y;vx;vy\n1,5;2;3;4\n", line=2, column="x", text="1,5")
    yield tracks("# id frame x y\n1 1 0 0\n", "--format frames", line=1, columns="id frame x y")
    for comment in ("# framerate: 16 fps", "# frame rate = 16"):
        yield tracks(f"{comment}\n1 1 0 0\n", "--format frames --fps 1", line=1, rate=16, fps=1)
        yield tracks(f"1 1 0 0\n{comment}\n2 1 0 1\n", "--format frames --fps 16", line=2)
    yield tracks("1 7 0 0\n1 8 1 0\n1 9 2 0\n", "--format frames", n=3)
    yield tracks("7 1 0 0\n8 1 1 0\n9 1 2 0\n", "--format ids", n=3)
    yield tracks("0 1 2 3\n1 0 4 5\n", frames="id '1' in frame '0', then id '0' in frame '1'",
                 ids="id '0' in frame '1', then id '1' in frame '0'")
    yield tracks("PK\3\4 and so on", what="is an archive of zip, or a workbook of a spreadsheet",
                 expected="a table exported as CSV")
    named = "--columns t=time,id=name,x=lon,y=lat"
    yield tracks("time,name,lon,lat\n", named, x="lon", y="lat")
    yield tracks("time,lon,lat\n", named + " --projection none", line=1, column="name",
                 columns="'time', 'lon', 'lat'")
    yield tracks("time,name\n", "--columns t=time,id=name", column="x")
    by_number = "--columns t=1,id=2,x=3,y=4"
    yield tracks("0,a,1\n", by_number, line=1, n=4)
    yield tracks("1 2 3 4 5\n", line=1, n=5)
    yield tracks("1,2,3,4\n", "--format frames", line=1)
    yield tracks("t,id,x,y\ns,,deg,deg\n", "--columns t=t,id=id,x=x,y=y", line=2, what="units", x="deg", y="deg")
    yield tracks("2024-05-01T00:00:00Z,a,8.0000,50.0000\n2024-05-01T00:16:40Z,a,8.5000,50.0000\n", by_number,
                 speed=0.0005)
    slow = "8.0000,50.0000\n{},a,8.5000,50.0000\n"
    yield tracks("1704067200,a," + slow.format(1704068200), by_number, speed=0.0005)
    yield tracks("t,id,gps_x,gps_y\n0,a," + slow.format(1000), "--columns t=t,id=id,x=gps_x,y=gps_y", x="gps_x",
                 y="gps_y", speed=0.0005)
    yield tracks("0;a;1,5;2\n", by_number, line=1, column=3, text="1,5")
    yield tracks('0,a,"1,5",2\n', by_number, line=1, column=3, text="1,5", separator=",")
    yield tracks('t,id,x,y\n0,a,"1",2\n', line=2, column="x", text='"1"')
    yield tracks("t,id,x,y\n1,0,a,1,2\n", line=2, n=5, columns=4)
    day = "t,id,x,y\n23:59:50,a,1,2\n00:00:10,a,1,2\n"
    yield tracks(day, line=2, column="t", text="23:59:50", format="%H:%M:%S")
    yield tracks(day, "--date-format %T")
    yield tracks("t,id,x,y\n20200131,a,1,2\n", text="20200131", format="%Y%m%d")
    yield tracks("<Tracks/>", line=1)
    yield tracks("<?xml version='1.0' encoding='windows-1252'?><fcd-export/>", line=1, encoding="windows-1252")
    yield tracks("0,a,10,60\n0,b,10,0\n", by_number + " --projection local", west=10, east=10, south=0, north=60,
                 error="73 %", other="0.036 %")
    yield tracks("0,a,10,60\n0,b,100,0\n", by_number + " --projection utm", west=10, east=100, south=0, north=60,
                 projection="utm", error="47 %")
    yield tracks("t,id,x,y\n05/03/2023 00:00:00,a,1,2\n", line=2, column="t", text="05/03/2023 00:00:00",
                 formats="--date-format '%d/%m/%Y %H:%M:%S' or --date-format '%m/%d/%Y %H:%M:%S'")
    yield tracks("date,time,id,x,y\n2024-05-01,,a,1,2\n", "--columns t=date+time,id=id,x=x,y=y", line=2, column="time")
    yield tracks("t,id,x,y\n5,a,1,2\n", "--date-format %Y-%m-%d", line=2, column="t", text="5", format="%Y-%m-%d")
    yield points("x,y,z,vx,vy,vz\n1,2,3,4,5,6\n1,3,4,4,5,6\n", line=3, column="z", number=4, other=3, first=2)
    walk = "".join(f"{person} {frame} {frame} {9 * person}\n" for person in range(4) for frame in range(5))
    yield tracks(walk, "--format frames", distance=9, other=1)
    for option in ("--areas a", "--mean-areas a"):
        yield simulate(option, option=option.split()[0])
    yield simulate("--cutoff 1", option="--cutoff")
    yield simulate("--walkable w --cutoff 1 --areas a", file="w", reason=NO_FILE,
                   content="a walkable area, as Well-Known Text")
    yield simulate("--cutoff 0 --areas a", option="--cutoff", number=0, lowest=1e-150, highest="1e+150")
    yield walkable("POINT (1 2)", line=1, column=1, here="'POINT' stands here")
    yield walkable("GEOMETRYCOLLECTION (LINESTRING (0 0, 1 1))", line=1, column=21,
                   here="'LINESTRING' stands here")
    yield walkable("GEOMETRYCOLLECTION(" * 100 + "POINT", line=1, column=1901, here="'POINT' stands here")
    yield walkable("POLYGON\nZ ((0 0, 1 0, 1 1, 0 0))", line=2, column=1, here="'Z' stands here")
    yield walkable("POLYGON ((0 0, 1 0, 1 1, 0 0)", line=1, column=30, here="the text ends here")
    yield walkable("POLYGON (0 0)", line=1, column=10, here="'0' stands here")
    yield walkable("POLYGON ((0 0, 1))", line=1, column=17, here="')' stands here")
    yield walkable("POLYGON ((0 0, 1;0))", line=1, column=17, here="';0' stands here")
    yield walkable("POLYGON ((0 0, 1 0, 1 1, 0 0));", line=1, column=31)
    yield walkable("POLYGON EMPTY\n", line=2, column=1)
    yield walkable("POLYGON ((0 0, 1 0, 1 1, 0 1))", line=1, column=11)
    yield walkable("POLYGON ((0 0, 1 0, 0 0))", line=1, column=11, n=2)
    yield walkable("POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))", ring="polygon 1", to="0 1", **{"from": "1 0"})
    yield walkable("POLYGON ((0 0, 1 1, 1 -1, 0 0, -1 1, -1 -1, 0 0))", ring="polygon 1")
    yield walkable("POLYGON ((0 0, 1 0, 0 1, 0 0), (5 5, 6 5, 5 6, 5 5))", ring="polygon 1, hole 1")
    yield walkable("MULTIPOLYGON (((0 0, 9 0, 0 9, 0 0)), ((1 1, 2 1, 1 2, 1 1)))", ring="polygon 2")
    yield simulate("--walkable w --areas a", file="w",
                   prepare=lambda d: (d / "w").write_bytes(b" " * 2**26))
    yield points("\n# c\nx,y,x,vx,vy\n", line=3, column="x", columns=POINTS_COLUMNS)
    yield points("x,y,vx\n1,2,3\n", line=1, column="vy", columns=POINTS_COLUMNS)
    yield tracks("t,id,x\n", line=1, column="y", columns=TRACKS_COLUMNS)
    yield points("x,y,vx,vy,ax\n1,2,3,4,5\n", line=1, column="ay", first="ax", second="ay")
    yield points("x,y,vx,vy,jy\n1,2,3,4,5\n", line=1, column="jx", first="jx", second="jy")
    yield points("x,y,vx,vy\n1,2,3,4\n1,2,3\n", line=3, n=3, columns=4)
    yield points("x,y,vx,vy\n1,2,3,4,5\n", line=2, n=5, columns=4)
    yield points("x,y,vx,vy\n1\n", line=2, columns=4)
    yield tracks("0 a 1\n", "--format frames", line=1, n=3)
    yield tracks("5\n", "--format frames", line=1)
    yield points("x,y,vx,vy\n1,,3,4\n", line=2, column="y")
    yield tracks("t,id,x,y\n1, ,3,4\n", line=2, column="id")
    yield points("x,y,vx,vy\n1,two,3,4\n", line=2, column="y", text="two")
    yield tracks("5 a zero 0\n", "--format frames", line=1, column="x", text="zero")
    yield points("x,y,vx,vy\n1,2,nan,4\n", line=2, column="vx", text="nan")
    yield points("x,y,vx,vy\n1,2,3,-inf\n", line=2, column="vy", text="-inf")
    yield points("x,y,vx,vy\n1e400,2,3,4\n", line=2, column="x", text="1e400")
    yield points("x,y,vx,vy,radius\n1,2,3,4,-1\n", line=2, radius=-1)
    yield points("x,y,vx,vy,mass\n1,2,3,4,0\n", line=2, mass=0)
    discs = "--until 1 --collisions elastic"
    yield points("x,y,vx,vy,radius\n1,1,1,0,0\n", discs, line=2)
    yield points("x,y,vx,vy,radius\n1,1,1,0,1e308\n", discs, line=2, radius="1e+308")
    yield points("x,y,vx,vy,radius,growth\n1,1,1,0,1,0\n5,5,0,0,1,-0.5\n",
                 "--until 3 --collisions elastic", line=3, time=2, until=3)
    yield points("x,y,vx,vy,radius,growth\n1,1,1,0,1,-0.25\n", "--until 5 --from 4.5 --collisions stop",
                 line=2, time=4.5)
    yield points("x,y,vx,vy\n1,1,1,0\n", "--until 5 --from -1 --regular --growth 2", line=2, time=-1)
    for response in ("swap", "elastic", "stop", "remove"):
        yield points("x,y,vx,vy,radius\n9,9,0,0,1\n1,1,1,0,1\n2,1,0,0,2\n",
                     f"--until 1 --collisions {response}", line=4, first=3, time=0, response=response)
    row = "x,y,vx,vy,radius\n0,0,0,0,1\n1,0,0,0,1\n2,0,0,0,1\n3,0,0,0,1\n4,0,0,0,2\n"
    yield points(row, "--until 1 --from 0.5 --collisions stop", line=3, first=2, time=0.5, response="stop",
                 others="3 and 4, 4 and 5, and 2 more pairs")
    yield points("x,y,vx,vy\n1,1,1,0\n", discs + " --growth 2 --mass area", line=2, radius=0)
    yield points("x,y,vx,vy,radius\n1,1,1,0,1e200\n", discs + " --mass area", line=2, radius="1e+200")
    yield points("x,y,vx,vy\n1,1,1,0\n", "--until 1 --rim --box -5,-5,15,5 --radius 5", line=2, radius=5,
                 time=0)
    yield points("x,y,vx,vy,radius\n1,1,1,0,1\n1,5,1,0,2\n", "--until 4 --rim --box -5,-5,15,5 --growth 1",
                 line=2, radius=5, time=4)
    refuse = "--until 1 --coincident refuse"
    yield points("x,y,vx,vy,radius\n1,1,1,0,1\n1,1,1,0,2\n", refuse, line=3, first=2, numbers="place and velocity")
    yield points(ONE_FLIP + "4,0,0,0\n", refuse, line=6, first=3, numbers="place and velocity")
    yield points("x,y,vx,vy,jx,jy\n1,2,3,4,5,6\n1,2,3,4,5,6\n", refuse, line=3, first=2,
                 numbers="place and derivatives")
    for columns, row, numbers in (("radius", "1,2,3,4,5", "place, velocity and radius"),
                                  ("radius,growth", "1,2,3,4,5,1", "place, velocity, radius and growth")):
        yield points(f"x,y,vx,vy,{columns}\n{row}\n{row}\n", refuse + " --regular", line=3, first=2, numbers=numbers)
    box = "--until 1 --box 0,0,10,10"
    yield points("x,y,vx,vy\n0,0,1,0\n5,12,0,0\n", box, line=3, point=1, time=0, x=5, y=12,
                 side="upper", position=10)
    yield points("x,y,vx,vy\n1,5,1,0\n5,5,0,0\n", box + " --rim --radius 2", line=2, point=0, time=0, x=1,
                 y=5, side="left", position=0)
    yield points("x,y,vx,vy\n0,5,1,0\n0,5,-1,0\n", box + " --coincident refuse", time=0, a=0, b=1)
    yield tracks("t,id,x,y\n0,a,0,0\n1,b,0,0\n0,a,2,1.5\n", line=4, id="a", time=0, x=2, y=1.5, x2=0,
                 y2=0, first=2)
    yield tracks("t,id,x,y,radius\n0,a,0,0,1\n1,a,1,0,2\n", line=3, id="a", radius=2, other=1, first=2)
    yield tracks("t,id,x,y,radius\n0,a,0,0,-1\n", line=2, radius=-1)
    yield tracks("t,id,x,y,radius\n0,a,0,0,0\n1,a,1,0,0\n", "--collisions log", line=2)
    yield tracks("t,id,x,y,radius\n0,a,0,0,1e308\n", "--collisions log", line=2, radius="1e+308")
    yield tracks("1e300 a 0 0\n", "--format frames --fps 1e-300", line=1, frame="1e+300", fps="1e-300")
    yield tracks("t,id,x,y\n0,a,-1e308,0\n1,a,1e308,0\n", line=3, id="a", first=2)
    yield tracks("t,id,x,y\n0,a,0,0\n1,a,1,0\n2,a,2,0\n0,b,0,5\n1,b,1,0\n2,b,2,0\n", "--coincident refuse",
                 line=6, time=1, a="a", b="b", first=3)
    yield tracks("t,id,x,y\n0,a,0,0\n9,a,0,0\n0,b,0,0\n9,b,0,0\n0,c,5,5\n5,c,7,7\n9,c,7,7\n0,d,5,6\n5,d,7,7\n9,d,7,7\n",
                 "--coincident refuse", line=4, time=0, a="a", b="b", first=2, others="'c' and 'd' from t = 5 on")


def cases():
    for some in (usage_cases, number_cases, meaning_cases, table_cases):
        yield from some()
