using FractalEngine.App.Window;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Exports.Gltf;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Drops a file on the window of the program, in the process of the tests.</summary>
[Collection(GlTests.Name)]
public sealed class DroppedFileTests : IDisposable
{
    private readonly IDisposable _focus = Display.TakeFocus(GlTests.Name);
    private readonly TemporaryFolder _folder = new();

    public void Dispose()
    {
        _folder.Dispose();
        _focus.Dispose();
    }

    [SkippableFact]
    public async Task Drop_OfABinaryGltf_OpensIt()
    {
        Display.Require();
        SdlQueue.SkipElsewhere();
        _folder.Write("cube.obj", SampleFiles.Cube);
        using (var stream = File.Create(_folder["dropped.glb"]))
        {
            new GltfExport().Write(AssetLoader.Load(_folder["cube.obj"]).Scene, new(), stream);
        }

        var recent = _folder["recent.txt"];
        var driver = Task.Run(() =>
        {
            try
            {
                WaitForRecent(_folder["cube.obj"]);
                SdlQueue.Drop(_folder["dropped.glb"]);
                WaitForRecent(_folder["dropped.glb"]);
            }
            finally
            {
                SdlQueue.Close();
            }
        });
        Assert.Equal(0, SceneWindow.Show(
            _folder["cube.obj"], new() { Size = (320, 240), IsTraced = false, WatchesFiles = false, RecentFilesPath = recent }));
        await driver;
        // Only what was opened is in the list.
        Assert.Equal([_folder["dropped.glb"], _folder["cube.obj"]], File.ReadAllLines(recent));

        void WaitForRecent(string path) => Polling.WaitUntil(
            () => File.Exists(recent) && File.ReadLines(recent).FirstOrDefault() == path, $"recent file {path}");
    }
}
