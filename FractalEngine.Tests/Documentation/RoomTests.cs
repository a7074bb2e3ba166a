using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Documentation;

/// <summary>Tests that the map of the rooms in CONTRIBUTING.md has every folder of the code.</summary>
public class RoomTests
{
    [Theory]
    [InlineData("Core")]
    [InlineData("Parsing")]
    [InlineData("Render")]
    [InlineData("App")]
    public void Rooms_OfAProject_AreInItsRow(string project)
    {
        var row = File.ReadLines(Repository.Full("CONTRIBUTING.md"))
            .Single(line => line.StartsWith($"| `FractalEngine.{project}`", StringComparison.Ordinal));
        var rooms = Directory.GetDirectories(Repository.Full($"FractalEngine.{project}")).Select(Path.GetFileName)
            .Where(name => name is not ("bin" or "obj" or "Properties"));
        Assert.All(rooms, room => Assert.Contains($"`{room}`", row, StringComparison.Ordinal));
    }
}
