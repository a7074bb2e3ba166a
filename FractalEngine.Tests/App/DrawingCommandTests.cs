using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>What tests of commands that draw have in common: a folder with the scene of a red cube, and the images drawn there.</summary>
public abstract class DrawingCommandTests : IDisposable
{
    private protected DrawingCommandTests()
    {
        Folder.Write("cube.obj", SampleFiles.Cube);
        Folder.Write("scene.sdo", "background (0, 0, 1)\no \"cube.obj\" # colour (1, 0, 0)\nc (0, 0, -3) # 60\n");
    }

    private protected TemporaryFolder Folder { get; } = new();

    public void Dispose()
    {
        Folder.Dispose();
        GC.SuppressFinalize(this);
    }

    /// <summary>Draws a file of the folder into a small image.</summary>
    private protected void Render(string file, string output, params string[] options)
    {
        Display.Require();
        var (exitCode, _, error) = Run(["render", file, "--output", output, "--resolution", "64x64", .. options]);
        Assert.True(exitCode == 0, error);
    }

    private protected byte[] Pixels(string file) => ReadImage(file).Pixels;

    private protected PixelImage ReadImage(string file) => ImageFile.Load(Folder[file]);

    /// <summary>Runs a command in the process of the tests: its classes belong to <see cref="ConsoleTests"/>.</summary>
    private protected AppResult Run(params string[] arguments) => AppInProcess.Run(Folder.Path, arguments);
}
