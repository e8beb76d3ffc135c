"""Compares many pairs on a Spark cluster: spark-submit --py-files pairs.py spark_pairs.py pairs.jsonl answers/

The lines are those of `nurbs-hausdorff batch`; all nodes must see the files that they name. Spark
repeats the partitions of a worker that died, and commits each partition once. Without Python on
the workers the native command does the same: `lines.pipe("nurbs-hausdorff batch - --jobs 1")`.
"""

import sys

from pyspark.sql import SparkSession

#: Lines in a partition: what is repeated if a worker dies.
PARTITION = 64


def compare(batches):
    """Answer the lines of a partition; prepared models live as long as the worker's process."""
    import pairs

    for batch in batches:
        yield batch.assign(value=[pairs.answer(line) for line in batch["value"]])


def run(spark, source, target, function=compare):
    """Answer the lines of a file into text files in a folder."""
    context = spark.sparkContext
    partitions = max(1, context.textFile(source).count() // PARTITION)
    # Parts of the file in its order, so that lines with the same model stay together.
    lines = context.textFile(source, partitions).map(lambda line: (line,))
    frame = spark.createDataFrame(lines, "value string")
    frame.mapInPandas(function, "value string").write.text(target)


if __name__ == "__main__":
    run(SparkSession.builder.getOrCreate(), sys.argv[1], sys.argv[2])
