using System.Diagnostics;
using System.Text.Json;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Architecture;

/// <summary>Packages: Render depends on OpenTK from NuGet, or is not packed.</summary>
public class PackagingTests
{
    private static readonly TimeSpan MaxTime = TimeSpan.FromSeconds(120);

    [Fact]
    public void Render_WithOpenTKOfNuGet_DependsOnIt() => Assert.Equal(["OpenTK", "StbImageSharp"], RenderPackages("nuget").Order());

    [Fact]
    public void Render_WithOpenTKOfDebian_HasNoSuchDependency() => Assert.Equal(["StbImageSharp"], RenderPackages("debian"));

    [Theory]
    [InlineData("debian", 1)]
    [InlineData("nuget", 0)]
    public void Render_Packed_NeedsOpenTKOfNuGet(string openTKSource, int exitCode)
    {
        var (found, output) = EvaluateRender("-t:RefuseToPackDebianOpenTK", $"-p:OpenTKSource={openTKSource}");
        Assert.Equal(exitCode, found);
        Assert.Equal(exitCode != 0, output.Contains("Pack with -p:OpenTKSource=nuget", StringComparison.Ordinal));
    }

    private static string[] RenderPackages(string openTKSource)
    {
        var (exitCode, output) = EvaluateRender("-getItem:PackageReference", $"-p:OpenTKSource={openTKSource}");
        Assert.Equal(0, exitCode);
        using var document = JsonDocument.Parse(output);
        var references = document.RootElement.GetProperty("Items").GetProperty("PackageReference");
        return [.. references.EnumerateArray().Select(reference => reference.GetProperty("Identity").GetString()!)];
    }

    private static (int ExitCode, string Output) EvaluateRender(params string[] arguments)
    {
        var project = Repository.Full("FractalEngine.Render/FractalEngine.Render.csproj");
        var start = new ProcessStartInfo("dotnet", ["msbuild", project, "-nologo", "-nodeReuse:false", .. arguments])
        {
            RedirectStandardOutput = true,
        };
        using var process = Process.Start(start)!;
        var output = process.StandardOutput.ReadToEndAsync();
        if (!process.WaitForExit(MaxTime))
        {
            process.Kill(entireProcessTree: true);
            throw new TimeoutException($"dotnet msbuild {string.Join(' ', arguments)} did not end within {MaxTime}");
        }

        return (process.ExitCode, output.GetAwaiter().GetResult());
    }
}
