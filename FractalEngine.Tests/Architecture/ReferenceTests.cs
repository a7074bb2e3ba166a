using System.Reflection;
using System.Xml.Linq;
using FractalEngine.Core;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Architecture;

/// <summary>Tests which assembly may refer to which: App ──► Render ──► Core ◄── Parsing ◄── App.</summary>
public class ReferenceTests
{
    [Fact]
    public void Core_RefersToTheFrameworkOnly()
    {
        Assert.All(Names(typeof(Vector).Assembly), name => Assert.StartsWith("System.", name, StringComparison.Ordinal));
        Assert.Equal(([], []), (Projects("Core"), Packages("Core")));
    }

    [Fact]
    public void Parsing_RefersToCoreTheFrameworkAndAReaderOfGltfOnly()
    {
        Assert.All(Names(typeof(SourceText).Assembly), name => Assert.Matches(@"^(System\..*|FractalEngine\.Core|SharpGLTF\.Core)$", name));
        Assert.Equal(["Core"], Projects("Parsing"));
        Assert.Equal(["SharpGLTF.Core"], Packages("Parsing"));
    }

    [Fact]
    public void Render_RefersToCoreAndNotToParsing()
    {
        Assert.Equal(["Core"], Projects("Render"));
        Assert.DoesNotContain("FractalEngine.Parsing", Names(Assembly.Load("FractalEngine.Render")));
    }

    [Fact]
    public void App_DoesNotReachThroughRenderToOpenTK() => Assert.DoesNotContain(
        Names(Assembly.Load("FractalEngine.App")), name => name.StartsWith("OpenTK", StringComparison.OrdinalIgnoreCase));

    [Theory]
    [InlineData("App")]
    [InlineData("Benchmarks")]
    [InlineData("Core")]
    [InlineData("Parsing")]
    public void OpenTK_IsKnownToRenderOnly(string project) =>
        Assert.DoesNotContain(Packages(project), package => package.StartsWith("OpenTK", StringComparison.OrdinalIgnoreCase));

    [Fact]
    public void Benchmarks_ReferToWhatTheyMeasure() => Assert.Equal(["Core", "Parsing", "Render"], Projects("Benchmarks").Order());

    [Theory]
    [InlineData("App")]
    [InlineData("Core")]
    [InlineData("Parsing")]
    [InlineData("Render")]
    public void Product_WaitsByNoTimeOfDay_WhichMayJump(string project) => Assert.All(
        Directory.EnumerateFiles(Repository.Full($"FractalEngine.{project}"), "*.cs", SearchOption.AllDirectories),
        file => Assert.DoesNotMatch(@"\bDateTime(Offset)?\.(Utc)?Now\b", File.ReadAllText(file)));

    // A process sets its limits once. The others are caches and the files to delete at the end, which change no result.
    [Fact]
    public void Core_HasNoStaticStateThatCanChange_ButLimitsAndCaches()
    {
        string[] changing =
        [
            .. from type in typeof(Vector).Assembly.GetTypes()
               where !type.Name.Contains('<', StringComparison.Ordinal)
               from field in type.GetFields(BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic)
               where !field.IsLiteral && (!field.IsInitOnly || IsCollection(field.FieldType) || HasSetter(field.FieldType))
               where field.FieldType != typeof(Limit)
               select $"{type.Name}.{field.Name}",
        ];
        Assert.Equal(
            ["ExpandedLevels.Shared", "MeshFeatures.Shared", "TemporaryFiles.Unfinished", "TriangleBvh.Shared"],
            changing.Order(StringComparer.Ordinal));
    }

    private static bool IsCollection(Type type) => type.Namespace!.StartsWith("System.", StringComparison.Ordinal)
        && !type.Namespace.EndsWith(".Immutable", StringComparison.Ordinal) && type.GetMethod("Clear", []) is not null;

    private static bool HasSetter(Type type) => type.Assembly == typeof(Vector).Assembly && type.IsClass
        && type.GetProperties().Any(static property => property.SetMethod is { } setter
            && !setter.ReturnParameter.GetRequiredCustomModifiers().Contains(typeof(System.Runtime.CompilerServices.IsExternalInit)));

    private static IEnumerable<string> Names(Assembly assembly) => assembly.GetReferencedAssemblies().Select(name => name.Name!);

    private static XDocument Project(string name) => XDocument.Load(Repository.Full($"FractalEngine.{name}/FractalEngine.{name}.csproj"));

    private static string[] Packages(string name) => [.. Includes(name, "PackageReference")];

    private static string[] Projects(string name) =>
        [.. Includes(name, "ProjectReference")
        .Select(path => Path.GetFileNameWithoutExtension(path.Replace('\\', '/'))["FractalEngine.".Length..])];

    private static IEnumerable<string> Includes(string name, string element) =>
        Project(name).Descendants(element).Select(reference => (string?)reference.Attribute("Include")).OfType<string>();
}
