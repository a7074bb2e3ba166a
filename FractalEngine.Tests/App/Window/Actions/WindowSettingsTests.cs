using FractalEngine.App.Window.Actions;
using FractalEngine.Render.Ui;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Actions;

/// <summary>Tests what the window remembers from one run to the next.</summary>
public sealed class WindowSettingsTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Settings_Written_AreReadAgain()
    {
        var settings = WindowSettings.Parse(
            "theme light\nscale 1.5\nmenu hidden\nstill drawn\npanel view open folded floating 20 60\nkey grid Ctrl+G\n");
        Assert.True(settings.IsLight);
        Assert.Equal(1.5, settings.Scale);
        Assert.False(settings.ShowsMenu);
        Assert.False(settings.IsTraced);
        Assert.True(new WindowSettings().IsTraced);
        Assert.Equal(settings.ToText(), WindowSettings.Parse(settings.ToText()).ToText());
        var panel = new UiPanel("View", static _ => { });
        settings.Panels["view"].ApplyTo(panel);
        Assert.Equal((true, true, UiDock.Floating, 20.0, 60.0), (panel.IsOpen, panel.IsFolded, panel.Dock, panel.X, panel.Y));
    }

    [Theory]
    [InlineData("theme pink")]
    [InlineData("still moving")]
    [InlineData("scale 0")]
    [InlineData("scale big")]
    [InlineData("panel view open")]
    [InlineData("panel view open folded sideways 1 2")]
    [InlineData("panel view open folded left 1 nan")]
    [InlineData("key grid Hyper+G")]
    [InlineData("key unknown G")]
    [InlineData("nonsense")]
    public void Settings_Broken_AreReportedByLine(string line)
    {
        var exception = Assert.Throws<InvalidDataException>(() => WindowSettings.Parse("# fine\n" + line + "\n"));
        Assert.StartsWith("line 2 is no setting", exception.Message, StringComparison.Ordinal);
        var path = _folder["window.txt"];
        File.WriteAllText(path, line);
        var messages = new List<string>();
        Assert.Equal(new WindowSettings().ToText(), WindowSettings.Read(path, messages.Add).ToText());
        Assert.Contains(path, Assert.Single(messages), StringComparison.Ordinal);
    }
}
