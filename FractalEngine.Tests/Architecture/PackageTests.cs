using System.IO.Compression;
using System.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Architecture;

/// <summary>Tests the packages of Core and Parsing as a stranger uses them: restored from a folder into a new project that runs.</summary>
public sealed class PackageTests : IDisposable
{
    private const string Version = "1.2.3-test";

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    [Trait("Category", "Soak")]
    public void Packages_RestoredIntoANewProject_RunASample()
    {
        var packages = _folder["packages"];
        foreach (var project in (string[])["Core", "Parsing"])
        {
            Run(
                Repository.Root,
                "pack",
                $"FractalEngine.{project}/FractalEngine.{project}.csproj",
                "--configuration=Release",
                $"--artifacts-path={_folder["artifacts"]}",
                $"--output={packages}",
                $"-p:Version={Version}");
            CheckContents(Path.Combine(packages, $"FractalEngine.{project}.{Version}.nupkg"), $"lib/net10.0/FractalEngine.{project}");
            Assert.True(File.Exists(Path.Combine(packages, $"FractalEngine.{project}.{Version}.snupkg")));
        }

        var sample = new SampleProgram("own-fractal.cs");
        var program = _folder["program"];
        Directory.CreateDirectory(program);
        File.WriteAllText(Path.Combine(program, "nuget.config"), $"""
            <configuration>
              <packageSources><clear /><add key="folder" value="{packages}" /></packageSources>
            </configuration>
            """);
        File.WriteAllText(Path.Combine(program, "program.csproj"), $"""
            <Project Sdk="Microsoft.NET.Sdk">
              <PropertyGroup>
                <OutputType>Exe</OutputType>
                <TargetFramework>net10.0</TargetFramework>
                <ImplicitUsings>enable</ImplicitUsings>
              </PropertyGroup>
              <ItemGroup><PackageReference Include="FractalEngine.Parsing" Version="{Version}" /></ItemGroup>
            </Project>
            """);
        File.WriteAllLines(Path.Combine(program, "Program.cs"), sample.Code);
        Assert.Equal(sample.ExpectedOutput, SampleProgram.SplitOutput(Run(program, "run")));
    }

    // What is restored stays in the folder of the test: other packages of the same name and version are not seen, nor are these left.
    private string Run(string folder, params string[] arguments)
    {
        var environment = new Dictionary<string, string> { ["NUGET_PACKAGES"] = _folder["restored"] };
        var (exitCode, output, error) = Dotnet.Run(folder, environment, arguments);
        Assert.True(exitCode == 0, output + error);
        return output;
    }

    private static void CheckContents(string package, string library)
    {
        using var archive = ZipFile.OpenRead(package);
        var names = archive.Entries.Select(entry => entry.FullName).ToArray();
        Assert.Contains("README.md", names);
        Assert.Contains(library + ".dll", names);
        Assert.Contains(library + ".xml", names);
        var machine = Encoding.UTF8.GetBytes(Repository.Root);
        foreach (var entry in archive.Entries)
        {
            using var stream = entry.Open();
            using var bytes = new MemoryStream();
            stream.CopyTo(bytes);
            Assert.True(bytes.ToArray().AsSpan().IndexOf(machine) < 0, $"{entry.FullName} names the folder that it was built in");
        }

        var specification = archive.Entries.Single(entry => entry.FullName.EndsWith(".nuspec", StringComparison.Ordinal));
        using var manifest = new StreamReader(specification.Open());
        var text = manifest.ReadToEnd();
        Assert.Contains("<license type=\"expression\">MIT</license>", text, StringComparison.Ordinal);
        Assert.Contains("<readme>README.md</readme>", text, StringComparison.Ordinal);
        Assert.Contains("<tags>", text, StringComparison.Ordinal);
    }
}
