using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Compares what commands that make images say, and the mean colours of what they trace, with what is recorded.</summary>
[Collection(ConsoleTests.Name)]
public sealed class RecordedImageTests : IDisposable
{
    // Colours may differ where another library of mathematics rounds to the next of 256 values.
    private const double ColourTolerance = 1e-3;

    private readonly Transcript _transcript = new();

    public RecordedImageTests()
    {
        RecordedCommandTests.WriteFiles(_transcript.Folder);
        _transcript.Folder.Write("cameras.txt",
            "# a list\n(0, 0, -3) (0, 0, 0) 60\n\n  c (1, 1, -3) look-at (0, 0, 0) 50\n(2, 0, -2) (0, 0.8, 0) 60\n");
        _transcript.Folder.Write("one-camera.txt", "(0, 0, -3) (0, 0, 0) 60\n");
        _transcript.Folder.Write("bad-camera.txt", "(0, 0, -3) (0, 0, 0) 60\n  c (1, 1) 3\n");
        _transcript.Folder.Write("far-camera.txt", "(0, 0, -3) (0, 0, 0) 60\n(1e151, 0, -3) (0, 0, 0) 60\n");
        _transcript.Folder.Write("right.sdo", "handed right\nc (0, 0, 4) (0, 0, 0) 40\no \"row.fdo\" #\nlight ambient (1, 1, 1)\n");
        _transcript.Folder.Write("still.sdo", "o \"cube.obj\" #\n");
        _transcript.Folder.Write("numbered.obj", File.ReadAllText(_transcript.Folder["m.obj"]).Replace("m.mtl", "numbered.mtl",
            StringComparison.Ordinal));
        _transcript.Folder.Write("numbered.mtl", "newmtl a\nmap_Kd b-0002.png\nnewmtl b\nmap_Kd b-0000.png\n");
        _transcript.Folder.Write("first.obj", "mtllib first.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
        _transcript.Folder.Write("first.mtl", "newmtl a\nmap_Kd d-0001.png\n");
        _transcript.Folder.Write("pair.fdo", SampleFiles.Row("1"));
        File.Copy(_transcript.Folder["a.png"], _transcript.Folder["d-0001.png"]);
        File.Copy(_transcript.Folder["a.png"], _transcript.Folder["b-0002.png"]);
        File.Copy(_transcript.Folder["a.png"], _transcript.Folder["b-0000.png"]);
    }

    public void Dispose() => _transcript.Dispose();

    [Fact]
    public void Render_Traced_IsAsRecorded() => Check(
        "images-render.txt", " --resolution 12x8",
        "render scene.sdo -o a.png --trace 2", "render scene.sdo -o b.png --trace 2 --seed 1 --verbose",
        "render scene.sdo -o c.png --trace 1 --quiet --projection orthographic",
        "render row.fdo -o d.png --trace 1 --background \"(1, 0, 0)\"",
        "render row.fdo -o e.png --trace 1 --view top", "render row.fdo -o f.png --trace 1 --view isometric",
        "render row.fdo -o f2.png --trace 1 --view isometric --projection perspective", "render row.fdo -o g.png --trace 1 --zoom 1.5",
        "render pair.fdo -o e.png --trace 1 --view isometric --composition componentwise",
        "render row.fdo -o g.png --trace 1 --zoom 9", "render scene.sdo -o g.png --trace 1 --zoom 1",
        "render row.fdo -o g.png --trace 1 --zoom 1 --projection orthographic", "render row.fdo -o g.png --trace 1 --zoom 1001",
        "render row.fdo -o h.png --trace 1 --look-from \"(1, 2, -3)\" --look-at \"(0.1, 0, 0)\" --up \"(1, 1, 0)\"",
        "render scene.sdo -o i.png --trace 1 --camera \"(0, 0, -3) (0, 0, 0.5) 60\"",
        "render scene.sdo -o j.png --trace 1 --section 1,0,0,0.2", "render drop.sdo -o k.png --trace 1 --time 0.5",
        "render drop.sdo -o k.png --trace 1 --time 3601", "render cube.obj -o k.png --trace 1 --time 1",
        "render scene.sdo -o l.png --trace 2 --seed 1", "render scene.sdo -o m.png --trace 1 --background \"(1, 1, 1)\"",
        "render scene.sdo -o o.png --trace 1 --background transparent",
        "render scene.sdo -o o.jpg --trace 1", "render scene.sdo -o o.png --trace 0", "render scene.sdo -o o.png --keep-partial",
        "render scene.sdo -o o.png --seed 3", "render m.obj -o a.png --trace 1", "render m.obj -o p.png --trace 1",
        "render scene.sdo -o o.png --trace 1 --background red", "render scene.sdo -o o.png --trace 1 --background \"(2, 0, 0)\"",
        "render scene.sdo -o o.png --trace 1 --camera \"(0, 0, -3)\"", "render scene.sdo -o o.png --trace 1 --look-from 1,2,3",
        "render scene.sdo -o o.png --trace 1 --look-at \"(a, 0, 0)\"", "render scene.sdo -o o.png --trace 1 --look-at 0 --up 0",
        "render scene.sdo -o o.png --trace 1 --look-at \"(0, 0, 0)\" --up \"(0, 0, 0)\"",
        "render scene.sdo -o o.png --trace 1 --look-at \"(0, 0, 0)\" --look-from \"(0, 0, 0)\"",
        "render scene.sdo -o o.png --trace 1 --look-at \"(0, 0, 0)\" --up \"(x, 0, 0)\"",
        "render scene.sdo -o o.png --trace 1 --up \"(0, 1, 0)\"",
        "render scene.sdo -o o.png --trace 1 --view top --camera \"(0, 0, -3) (0, 0, 0.5) 60\"",
        "render scene.sdo -o o.png --trace 1 --view side", "render scene.sdo -o o.png --trace 1 --section 1,0,0",
        "render scene.sdo -o o.png --trace 1 --section 1,0,0,x", "render scene.sdo -o o.png --trace 1 --section 0,0,0,1",
        "render scene.sdo -o o.png --trace 1 --projection flat", "render missing.sdo -o o.png --trace 1");

    [Fact]
    public void Render_OfSizes_IsAsRecorded() => Check(
        "images-sizes.txt", "",
        "render scene.sdo -o a.png --trace 1 --resolution 12x", "render scene.sdo -o a.png --trace 1 --resolution 0x8",
        "render scene.sdo -o a.png --trace 1 --resolution 8x1000001", "render scene.sdo -o a.png --trace 1 --resolution 8193x8192",
        "render scene.sdo -o a.png --trace 1 --resolution 8x8x8", "render scene.sdo -o a.png --trace 1 --resolution \" 8x8\"",
        "render scene.sdo -o a.png --trace 1 --resolution 1x1", "render scene.sdo -o a.png --trace 1 --resolution 3x2 --resolution 4x2",
        "render scene.sdo -o b.png --trace 1 --resolution 3x2 --trace 2", "render row.fdo -o q.png --resolution 3x2 --trace",
        "render scene.sdo -o b.png --samples 33",
        "render scene.sdo -o b.png --samples -1", "render scene.sdo -o b.png --detail 1001", "render scene.sdo -o b.png --detail -0.1",
        "render scene.sdo -o b.png --instances 0", "render scene.sdo -o b.png --instances 100000001",
        "render scene.sdo -o b.png --shading flat",
        "render scene.sdo");

    [Fact]
    public void Animate_Traced_IsAsRecorded() => Check(
        "images-animate.txt", " --resolution 6x4",
        "animate row.fdo -o a.apng --turntable --frames 3 --trace 1", "animate row.fdo -o a.png --turntable --frames 2 --trace 1",
        "animate row.fdo -o c.apng --zoom 1 --frames 3 --fps 5 --trace 1 --quiet",
        "animate scene.sdo -o d.apng --path cameras.txt --frames 4 --trace 1",
        "animate right.sdo -o d.apng --path cameras.txt --frames 1 --trace 1 --verbose",
        "animate drop.sdo -o e.apng --simulate --frames 3 --fps 10 --trace 1",
        "animate drop.sdo -o f.png --simulate --frames 2 --fps 7 --trace 1",
        "animate drop.sdo -o g.apng --simulate --turntable --frames 2 --time 0.4 --trace 1",
        "animate scene.sdo -o h.apng --path one-camera.txt --trace 1", "animate scene.sdo -o h.apng --path bad-camera.txt --trace 1",
        "animate scene.sdo -o h.apng --path far-camera.txt --trace 1", "animate scene.sdo -o h.apng --path missing.txt --trace 1",
        "animate still.sdo -o h.apng --simulate --trace 1", "animate scene.sdo -o h.apng --trace 1",
        "animate scene.sdo -o h.apng --turntable --zoom 1 --trace 1",
        "animate scene.sdo -o h.apng --turntable --path cameras.txt --trace 1",
        "animate scene.sdo -o h.apng --path cameras.txt --view top --trace 1",
        "animate scene.sdo -o h.apng --path cameras.txt --camera \"\" --trace 1",
        "animate scene.sdo -o h.gif --turntable --fps 101 --trace 1", "animate scene.sdo -o h.mp4 --turntable --background transparent",
        "animate scene.sdo -o h.webm --turntable --background transparent", "animate scene.sdo -o h.avi --turntable --trace 1",
        "animate scene.sdo -o h.png --turntable --fps 5 --trace 1", "animate scene.sdo -o h.apng --turntable --frames 0",
        "animate scene.sdo -o h.apng --turntable --frames 100001", "animate scene.sdo -o h.apng --turntable --fps 656",
        "animate scene.sdo -o h.apng --turntable --fps 0.001", "animate scene.sdo -o h.apng --turntable --seed 1",
        "animate scene.sdo -o h.apng --turntable --keep-partial", "animate scene.sdo --turntable",
        "animate numbered.obj -o b.png --turntable --frames 2 --trace 1", "animate numbered.obj -o b.png --turntable --frames 1 --trace 1",
        "animate first.obj -o d.png --turntable --frames 2 --trace 1",
        "animate row.fdo -o h.apng --zoom 5 --frames 2 --trace 1", "animate pair.fdo -o h.apng --zoom 5 --frames 2 --trace 1",
        "animate row.fdo -o h.apng --turntable --trace 1 --background transparent");

    /// <summary>The encoder itself is a large package; here another program takes its name, and writes what it was asked.</summary>
    [SkippableFact]
    public void Animate_OfVideos_AsksTheEncoderAsRecorded()
    {
        Elsewhere.SkipOnWindows("there are no shell scripts");
        const string script =
            "#!/bin/sh\ncat >/dev/null\necho \"$@\" >arguments.txt\nfor last; do :; done\necho video >\"${last#file:}\"\n";
        _transcript.Folder.Write("bin/ffmpeg", script);
        _transcript.Folder.Write("broken/ffmpeg", "#!/bin/sh\ncat >/dev/null\necho 'no such\ncodec' >&2\nexit 3\n");
        string? before = Environment.GetEnvironmentVariable("PATH");
        try
        {
            foreach (string folder in (string[])["bin", "broken", "none"])
            {
                if (folder != "none" && !OperatingSystem.IsWindows())
                {
                    File.SetUnixFileMode(_transcript.Folder[$"{folder}/ffmpeg"], UnixFileMode.UserRead | UnixFileMode.UserExecute);
                }

                Environment.SetEnvironmentVariable(
                    "PATH", folder == "none" ? _transcript.Folder[folder] : $"{_transcript.Folder[folder]}:{before}");
                _transcript.Run([.. ((string[])["a.mp4 --fps 12.5", "v/b.WEBM", "c.gif --fps 100"]).Select(
                    output => $"animate row.fdo -o {output} --turntable --frames 2 --trace 1 --resolution 5x3")]);
            }
        }
        finally
        {
            Environment.SetEnvironmentVariable("PATH", before);
        }

        RecordedText.Check("images-videos.txt", _transcript.Lines);
    }

    private void Check(string file, string options, params string[] commandLines)
    {
        _transcript.Run([.. commandLines.Select(line => line + options)]);
        RecordedText.Check(file, _transcript.Lines, ColourTolerance);
    }
}
